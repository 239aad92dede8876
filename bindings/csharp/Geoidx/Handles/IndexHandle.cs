using System;
using System.Runtime.InteropServices;

namespace Geoidx
{
    internal sealed unsafe class IndexHandle : OwnedHandle
    {
        private IndexHandle(IntPtr index, AllocatorCallback? allocator) : base(allocator) => SetHandle(index);

        internal static IndexHandle Build(NativeMesh mesh, BuildOptions? options, BuildCallbacks callbacks)
        {
            using CallsInFlight.Call call = CallsInFlight.BeginCall();
            using var pinned = new PinnedBuildOptions(options, callbacks);
            NativeBuildOptions native = pinned.Native;
            AllocatorCallback? allocator = UseAllocator(options?.Allocator, ref native.allocator);
            GeodesicStatus status = NativeMethods.geoidx_build(&mesh, &native, out IntPtr index);
            if (status == GeodesicStatus.Ok) return new IndexHandle(index, allocator);
            allocator?.Dispose();
            callbacks.Rethrow();
            throw status.ToExceptionOfOptions();
        }

        internal static IndexHandle Open(string path, OpenOptions? options)
        {
            using PinnedMesh? expected = options?.ExpectedMesh?.Pin();
            NativeMesh mesh = expected?.Native ?? default;
            NativeOpenOptions native = NativeOptions(options, expected == null ? null : &mesh);
            AllocatorCallback? allocator = UseAllocator(options?.Allocator, ref native.allocator);
            return Own(NativeMethods.geoidx_open(path, &native, out IntPtr index), index, allocator);
        }

        internal static IndexHandle Open(ReadOnlySpan<byte> data, OpenOptions? options)
        {
            using PinnedMesh? expected = options?.ExpectedMesh?.Pin();
            NativeMesh mesh = expected?.Native ?? default;
            NativeOpenOptions native = NativeOptions(options, expected == null ? null : &mesh);
            AllocatorCallback? allocator = UseAllocator(options?.Allocator, ref native.allocator);
            fixed (byte* bytes = &MemoryMarshal.GetReference(data))
            {
                GeodesicStatus status =
                    NativeMethods.geoidx_open_memory(bytes, (ulong)data.Length, &native, out IntPtr index);
                return Own(status, index, allocator);
            }
        }

        protected override void CloseNative() => NativeMethods.geoidx_close(handle);

        private static NativeOpenOptions NativeOptions(OpenOptions? options, NativeMesh* expected)
        {
            NativeOpenOptions native = NativeDefaults.OpenOptions();
            native.expected_mesh = expected;
            if (options == null) return native;
            if (options.Pairs) native.flags |= (uint)OpenFlags.Pairs;
            if (!options.Labels) native.flags |= (uint)OpenFlags.NoLabels;
            native.threads = Arguments.NotNegative(options.Threads, nameof(options.Threads));
            native.max_vertices = Arguments.NotNegative(options.MaxVertices, nameof(options.MaxVertices));
            native.max_memory = Arguments.NotNegative(options.MaxMemory, nameof(options.MaxMemory));
            return native;
        }

        private static AllocatorCallback? UseAllocator(IGeodesicAllocator? allocator, ref NativeAllocator native)
        {
            if (allocator == null) return null;
            var callback = new AllocatorCallback(allocator);
            native = callback.Native;
            return callback;
        }

        private static IndexHandle Own(GeodesicStatus status, IntPtr index, AllocatorCallback? allocator)
        {
            if (status == GeodesicStatus.Ok) return new IndexHandle(index, allocator);
            allocator?.Dispose();
            throw status.ToException();
        }
    }
}
