using System;
using System.Runtime.InteropServices;
using System.Threading;

namespace Geoidx.Tests
{
    /// <summary>Memory from the runtime, counted.</summary>
    internal sealed class CountingAllocator : IGeodesicAllocator
    {
        private long bytes;

        internal long Bytes => Interlocked.Read(ref bytes);

        // The word before an aligned block is where the block that it lies in begins.
        public IntPtr Allocate(ulong size, ulong alignment)
        {
            Interlocked.Add(ref bytes, (long)size);
            IntPtr block = Marshal.AllocHGlobal((IntPtr)(long)(size + alignment + 8));
            long aligned = (block.ToInt64() + 8 + (long)alignment - 1) & ~((long)alignment - 1);
            Marshal.WriteIntPtr(new IntPtr(aligned - 8), block);
            return new IntPtr(aligned);
        }

        public void Release(IntPtr memory, ulong size, ulong alignment)
        {
            Interlocked.Add(ref bytes, -(long)size);
            Marshal.FreeHGlobal(Marshal.ReadIntPtr(memory - 8));
        }
    }
}
