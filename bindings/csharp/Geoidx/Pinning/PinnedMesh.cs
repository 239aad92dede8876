using System;
using System.Buffers;

namespace Geoidx
{
    /// <summary>The arrays of a mesh, held in place.</summary>
    internal sealed unsafe class PinnedMesh : IDisposable
    {
        private MemoryHandle positions;
        private MemoryHandle triangles;

        internal PinnedMesh(MemoryHandle positions, MemoryHandle triangles, NativeMesh native)
        {
            this.positions = positions;
            this.triangles = triangles;
            native.positions = positions.Pointer;
            native.triangles = (int*)triangles.Pointer;
            Native = native;
        }

        internal NativeMesh Native { get; }

        public void Dispose()
        {
            positions.Dispose();
            triangles.Dispose();
        }
    }
}
