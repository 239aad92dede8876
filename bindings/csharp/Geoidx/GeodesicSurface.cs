using System;

namespace Geoidx
{
    /// <summary>
    /// A mesh with its adjacency, for points of the surface and paths. Immutable: any number of threads may use one at
    /// once, with queries of indices that were built from this mesh.
    /// </summary>
    public sealed class GeodesicSurface : IDisposable
    {
        private readonly SurfaceHandle handle;

        /// <summary>Makes the surface of a mesh.</summary>
        /// <param name="mesh">The mesh; its arrays are not needed afterwards.</param>
        /// <param name="weldTolerance">That of the index, <see cref="BuildOptions.WeldTolerance"/>.</param>
        /// <exception cref="GeodesicException">The status says what failed, the message where.</exception>
        public GeodesicSurface(GeodesicMesh mesh, double weldTolerance = 0)
        {
            if (mesh == null) throw new ArgumentNullException(nameof(mesh));
            GeodesicLibrary.Load();
            using PinnedMesh pinned = mesh.Pin();
            handle = SurfaceHandle.Create(pinned.Native, weldTolerance);
        }

        /// <summary>
        /// Makes the surface of the mesh that an index keeps, <see cref="BuildOptions.StoreMesh"/>: the same as that of
        /// the mesh which it was built from. It may be used when the index is disposed.
        /// </summary>
        /// <param name="index">The index.</param>
        /// <exception cref="GeodesicArgumentException">
        /// The index keeps no mesh, see <see cref="GeodesicInfo.HasMesh"/>.
        /// </exception>
        /// <exception cref="GeodesicException">
        /// The mesh in the file is not the one that the index was built from.
        /// </exception>
        public GeodesicSurface(GeodesicIndex index)
        {
            if (index == null) throw new ArgumentNullException(nameof(index));
            handle = SurfaceHandle.Of(index.Handle);
        }

        /// <summary>Makes the surface of the mesh that an index keeps for paths by the costs that it was built with.</summary>
        /// <param name="index">The index.</param>
        /// <param name="ofIndex">
        /// The options of the index, of which the costs and <see cref="BuildOptions.PointsPerEdge"/> count; their arrays
        /// are not needed afterwards.
        /// </param>
        /// <exception cref="GeodesicException">The status says what failed, the message where.</exception>
        public GeodesicSurface(GeodesicIndex index, BuildOptions ofIndex)
        {
            if (index == null) throw new ArgumentNullException(nameof(index));
            if (ofIndex == null) throw new ArgumentNullException(nameof(ofIndex));
            using var callbacks = new BuildCallbacks(ofIndex, null, default);
            using var options = new PinnedBuildOptions(ofIndex, callbacks);
            handle = SurfaceHandle.Of(index.Handle, options.Native);
        }

        /// <summary>Makes the surface of a mesh for paths by the costs that an index was built with.</summary>
        /// <param name="mesh">The mesh; its arrays are not needed afterwards.</param>
        /// <param name="ofIndex">
        /// The options of the index, of which <see cref="BuildOptions.WeldTolerance"/>, the costs and
        /// <see cref="BuildOptions.PointsPerEdge"/> count; their arrays are not needed afterwards.
        /// </param>
        /// <exception cref="GeodesicException">The status says what failed, the message where.</exception>
        public GeodesicSurface(GeodesicMesh mesh, BuildOptions ofIndex)
        {
            if (mesh == null) throw new ArgumentNullException(nameof(mesh));
            if (ofIndex == null) throw new ArgumentNullException(nameof(ofIndex));
            GeodesicLibrary.Load();
            using PinnedMesh pinned = mesh.Pin();
            using var callbacks = new BuildCallbacks(ofIndex, null, default);
            using var options = new PinnedBuildOptions(ofIndex, callbacks);
            handle = SurfaceHandle.Create(pinned.Native, options.Native);
        }

        internal SurfaceHandle Handle => handle;

        /// <summary>A vertex as a point of the surface: a corner of one of its triangles.</summary>
        /// <exception cref="GeodesicArgumentException">
        /// The vertex is out of range, or no triangle that is not degenerate uses it.
        /// </exception>
        public unsafe SurfacePoint VertexPoint(int vertex)
        {
            SurfacePoint point;
            NativeMethods.geoidx_vertex_point(handle, vertex, &point).ThrowIfError();
            return point;
        }

        /// <summary>The point of the surface that is nearest to a position in space.</summary>
        /// <exception cref="GeodesicArgumentException">A coordinate is not finite.</exception>
        public SurfacePoint ClosestPoint(double x, double y, double z) => ClosestPoint(x, y, z, out _);

        /// <summary>The point of the surface that is nearest to a position in space, and how far it is.</summary>
        /// <param name="x">The first coordinate.</param>
        /// <param name="y">The second coordinate.</param>
        /// <param name="z">The third coordinate.</param>
        /// <param name="distance">The straight distance in space, in the mesh's unit.</param>
        /// <exception cref="GeodesicArgumentException">A coordinate is not finite.</exception>
        public unsafe SurfacePoint ClosestPoint(double x, double y, double z, out double distance)
        {
            double* position = stackalloc double[] { x, y, z };
            SurfacePoint point;
            double length;
            NativeMethods.geoidx_closest_point(handle, position, &point, &length).ThrowIfError();
            distance = length;
            return point;
        }

        /// <summary>Frees the surface.</summary>
        public void Dispose() => handle.Dispose();
    }
}
