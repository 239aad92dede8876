using System;
using System.Buffers;

namespace Geoidx
{
    /// <summary>
    /// The arrays of a triangle mesh, which are not copied: leave them alone while a call uses them. Ids of vertices
    /// are positions in the array. Vertices with equal positions are one, degenerate and duplicate triangles are
    /// dropped, and a vertex that no triangle uses is unreachable.
    /// </summary>
    public sealed class GeodesicMesh
    {
        private readonly Func<MemoryHandle> pinPositions;
        private readonly Func<MemoryHandle> pinTriangles;
        private readonly MeshLayout layout;
        private readonly int positionElements;
        private readonly int corners;

        private GeodesicMesh(
            MeshLayout layout, Func<MemoryHandle> pinPositions, int positionElements, ReadOnlyMemory<int> triangles)
        {
            this.layout = layout;
            this.pinPositions = pinPositions;
            this.positionElements = positionElements;
            pinTriangles = triangles.Pin;
            corners = triangles.Length;
        }

        /// <summary>A mesh of these arrays.</summary>
        /// <typeparam name="TVertex">
        /// float or double: x, y and z of a vertex are three elements. Any other struct is one vertex and begins with
        /// its position.
        /// </typeparam>
        /// <param name="positions">Of the vertices, in the mesh's own unit.</param>
        /// <param name="triangles">Three vertices a triangle.</param>
        /// <param name="type">
        /// What a struct's position consists of; not read for float and double. Null: doubles if the struct's first
        /// field is a double or begins with one, floats otherwise.
        /// </param>
        /// <exception cref="GeodesicArgumentException">
        /// <typeparamref name="TVertex"/> has no room for a position.
        /// </exception>
        public static GeodesicMesh From<TVertex>(
            TVertex[] positions, int[] triangles, PositionType? type = null) where TVertex : unmanaged =>
            From(
                (ReadOnlyMemory<TVertex>)(positions ?? throw new ArgumentNullException(nameof(positions))),
                triangles ?? throw new ArgumentNullException(nameof(triangles)),
                type);

        /// <inheritdoc cref="From{TVertex}(TVertex[], int[], PositionType?)"/>
        public static GeodesicMesh From<TVertex>(
            ReadOnlyMemory<TVertex> positions, ReadOnlyMemory<int> triangles, PositionType? type = null)
            where TVertex : unmanaged =>
            new GeodesicMesh(MeshLayout.Of<TVertex>(type), positions.Pin, positions.Length, triangles);

        internal PinnedMesh Pin()
        {
            NativeMesh native = layout.Describe(positionElements, corners);
            MemoryHandle positions = pinPositions();
            try
            {
                return new PinnedMesh(positions, pinTriangles(), native);
            }
            catch
            {
                positions.Dispose();
                throw;
            }
        }
    }
}
