using System;
using System.Runtime.InteropServices;

namespace Geoidx
{
    internal sealed class AllocatorCallback : UserCallback
    {
        private static readonly AllocateFunction AllocateEntry = OnAllocate;
        private static readonly ReleaseFunction ReleaseEntry = OnRelease;

        private readonly IGeodesicAllocator allocator;

        internal AllocatorCallback(IGeodesicAllocator allocator) => this.allocator = allocator;

        internal NativeAllocator Native => new NativeAllocator
        {
            allocate = Marshal.GetFunctionPointerForDelegate(AllocateEntry),
            release = Marshal.GetFunctionPointerForDelegate(ReleaseEntry),
            user = User,
        };

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate IntPtr AllocateFunction(IntPtr user, ulong size, ulong alignment);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate void ReleaseFunction(IntPtr user, IntPtr memory, ulong size, ulong alignment);

        [MonoPInvokeCallback(typeof(AllocateFunction))]
        private static IntPtr OnAllocate(IntPtr user, ulong size, ulong alignment)
        {
            try
            {
                return Of<AllocatorCallback>(user).allocator.Allocate(size, alignment);
            }
            catch (Exception)
            {
                return IntPtr.Zero;
            }
        }

        [MonoPInvokeCallback(typeof(ReleaseFunction))]
        private static void OnRelease(IntPtr user, IntPtr memory, ulong size, ulong alignment)
        {
            try
            {
                Of<AllocatorCallback>(user).allocator.Release(memory, size, alignment);
            }
            catch (Exception)
            {
                // Nothing can be done for memory that its owner does not take back.
            }
        }
    }
}
