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

        internal SurfaceHandle Handle => handle;

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
