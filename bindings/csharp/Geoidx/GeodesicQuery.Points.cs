using System;
using System.Runtime.InteropServices;

namespace Geoidx
{
    /// <content>Points of the surface, and paths between them.</content>
    public sealed partial class GeodesicQuery
    {
        /// <summary>The distance between two points of the surface, in the mesh's unit.</summary>
        /// <param name="surface">Of the index's mesh.</param>
        /// <param name="source">The one point.</param>
        /// <param name="target">The other.</param>
        /// <exception cref="GeodesicArgumentException">
        /// A point is not on the surface, or the index has another metric than lengths.
        /// </exception>
        /// <exception cref="GeodesicMeshMismatchException">The surface is that of another mesh.</exception>
        public unsafe float Distance(GeodesicSurface surface, SurfacePoint source, SurfacePoint target)
        {
            using SingleUse.Scope scope = use.Begin();
            NativeMethods.geoidx_query_point_sssd(handle, HandleOf(surface), &source, &target, out float distance)
                .ThrowIfError();
            return distance;
        }

        /// <summary>The distance of every vertex to the nearest of some points of the surface.</summary>
        /// <param name="surface">Of the index's mesh.</param>
        /// <param name="sources">One or more points.</param>
        /// <param name="offsets">A distance for each source to begin with, or empty.</param>
        /// <param name="distances">One for each vertex, in the mesh's unit.</param>
        /// <exception cref="GeodesicArgumentException">
        /// A point is not on the surface, or a number of offsets or distances is wrong.
        /// </exception>
        /// <exception cref="GeodesicMeshMismatchException">The surface is that of another mesh.</exception>
        public unsafe void FromPoints(
            GeodesicSurface surface, ReadOnlySpan<SurfacePoint> sources, ReadOnlySpan<float> offsets,
            Span<float> distances)
        {
            CheckOffsets(offsets, sources.Length);
            using SingleUse.Scope scope = use.Begin();
            fixed (SurfacePoint* first = &MemoryMarshal.GetReference(sources))
            fixed (float* begin = &MemoryMarshal.GetReference(offsets))
            fixed (float* results = &MemoryMarshal.GetReference(distances))
                NativeMethods.geoidx_query_point_msad(
                    handle, HandleOf(surface), first, (uint)sources.Length, offsets.IsEmpty ? null : begin, results,
                    (uint)distances.Length).ThrowIfError();
        }

        /// <summary>
        /// Finds a path between two points of the surface and keeps it for <see cref="PathPoints"/>, until the next one.
        /// </summary>
        /// <param name="surface">Of the index's mesh.</param>
        /// <param name="source">Where it begins.</param>
        /// <param name="target">Where it ends.</param>
        /// <param name="length">Its length, in the mesh's unit.</param>
        /// <param name="quality">How short it is to be.</param>
        /// <returns>Whether there is one: not between points of different components.</returns>
        /// <exception cref="GeodesicArgumentException">
        /// A point is not on the surface, or the index has another metric than lengths.
        /// </exception>
        /// <exception cref="GeodesicMeshMismatchException">The surface is that of another mesh.</exception>
        public unsafe bool TryFindPath(
            GeodesicSurface surface, SurfacePoint source, SurfacePoint target, out double length,
            PathQuality quality = PathQuality.Straight)
        {
            using SingleUse.Scope scope = use.Begin();
            GeodesicStatus status = NativeMethods.geoidx_query_path(
                handle, HandleOf(surface), &source, &target, quality, out length);
            if (status == GeodesicStatus.NoPath) return false;
            status.ThrowIfError();
            return true;
        }

        /// <summary>How many points the latest path has; 0 if there is none.</summary>
        public unsafe int PathPointCount
        {
            get
            {
                using SingleUse.Scope scope = use.Begin();
                NativeMethods.geoidx_query_path_points(handle, null, 0, out ulong count).ThrowIfError();
                return checked((int)count);
            }
        }

        /// <summary>Copies the points of the latest path, from its source to its target.</summary>
        /// <param name="points">Has room for <see cref="PathPointCount"/> of them.</param>
        /// <returns>How many there are.</returns>
        /// <exception cref="GeodesicArgumentException">There are more points than there is room for.</exception>
        public unsafe int PathPoints(Span<PathPoint> points)
        {
            using SingleUse.Scope scope = use.Begin();
            ulong count;
            fixed (PathPoint* first = &MemoryMarshal.GetReference(points))
                NativeMethods.geoidx_query_path_points(
                    handle, points.IsEmpty ? null : first, (ulong)points.Length, out count).ThrowIfError();
            if (points.IsEmpty && count > 0)
                throw new GeodesicArgumentException($"The path has {count} points, but there is no room for any.");
            return (int)count;
        }

        /// <summary>
        /// Keeps the target of <see cref="TryNextStep"/> until the next call of this. One that the native library
        /// refuses leaves none.
        /// </summary>
        /// <param name="surface">Of the index's mesh.</param>
        /// <param name="target">Where steps lead to.</param>
        /// <exception cref="GeodesicArgumentException">
        /// The point is not on the surface, or the index has another metric than lengths.
        /// </exception>
        /// <exception cref="GeodesicMeshMismatchException">The surface is that of another mesh.</exception>
        public unsafe void PrepareTarget(GeodesicSurface surface, SurfacePoint target)
        {
            using SingleUse.Scope scope = use.Begin();
            NativeMethods.geoidx_query_prepare_target(handle, HandleOf(surface), &target).ThrowIfError();
        }

        /// <summary>
        /// The next step of whoever walks to the target that was prepared and asks on the way, wherever it is. Steps
        /// that begin where the one before ended lead to the target as a path of
        /// <see cref="PathQuality.Straight"/> does.
        /// </summary>
        /// <remarks>
        /// The first step takes as long as a path, whose triangles are kept. From any point of these a step takes a few
        /// microseconds; from a point beside them a new path is found. With <see cref="MetricKind.Edges"/> steps lead
        /// from corner to corner.
        /// </remarks>
        /// <param name="surface">That of the target.</param>
        /// <param name="from">Where the step begins.</param>
        /// <param name="start">Takes that point on the triangle that the way crosses next.</param>
        /// <param name="end">
        /// Takes where the way leaves this triangle, or the target: the way leads there straight. At the target it is
        /// the same as <paramref name="start"/>.
        /// </param>
        /// <param name="distance">
        /// Takes how long the way is from <paramref name="from"/> on, in the mesh's unit: 0 at the target, infinite if
        /// there is no way.
        /// </param>
        /// <returns>Whether there is a way: not if the target is in another component.</returns>
        /// <exception cref="GeodesicArgumentException">
        /// The point is not on the surface, or no target is prepared.
        /// </exception>
        /// <exception cref="GeodesicMeshMismatchException">The surface is that of another mesh.</exception>
        public unsafe bool TryNextStep(
            GeodesicSurface surface, SurfacePoint from, out PathPoint start, out PathPoint end, out double distance)
        {
            using SingleUse.Scope scope = use.Begin();
            PathPoint* step = stackalloc PathPoint[2];
            GeodesicStatus status = NativeMethods.geoidx_query_next_step(
                handle, HandleOf(surface), &from, step, out distance);
            if (status == GeodesicStatus.NoPath)
            {
                start = end = default;
                distance = double.PositiveInfinity;
                return false;
            }
            status.ThrowIfError();
            start = step[0];
            end = step[1];
            return true;
        }

        private static SurfaceHandle HandleOf(GeodesicSurface surface) =>
            (surface ?? throw new ArgumentNullException(nameof(surface))).Handle;
    }
}
