using System;
using System.Runtime.InteropServices;

namespace Geoidx
{
    /// <content>What is near to points of the surface.</content>
    public sealed partial class GeodesicQuery
    {
        /// <summary>The nearest of some points of the surface to every vertex.</summary>
        /// <remarks>Of several points at one vertex it is the first.</remarks>
        /// <param name="surface">Of the index's mesh.</param>
        /// <param name="sources">One or more points.</param>
        /// <param name="offsets">A distance for each source to begin with, or empty.</param>
        /// <param name="nearest">
        /// One for each vertex; takes the position in <paramref name="sources"/> of the one with the least offset and
        /// distance together, or <see cref="NoSource"/> where no source is reached.
        /// </param>
        /// <param name="distances">
        /// As long as <paramref name="nearest"/>, or empty; takes what <see cref="FromPoints"/> gives.
        /// </param>
        /// <exception cref="GeodesicArgumentException">
        /// A point is not on the surface, or a number of offsets, vertices or distances is wrong.
        /// </exception>
        /// <exception cref="GeodesicMeshMismatchException">The surface is that of another mesh.</exception>
        public unsafe void NearestSources(
            GeodesicSurface surface, ReadOnlySpan<SurfacePoint> sources, ReadOnlySpan<float> offsets,
            Span<int> nearest, Span<float> distances = default)
        {
            CheckOffsets(offsets, sources.Length);
            Lengths.CheckEqual(VertexCount, nearest.Length, nameof(nearest));
            if (!distances.IsEmpty) Lengths.CheckEqual(nearest.Length, distances.Length);
            using SingleUse.Scope scope = use.Begin();
            fixed (SurfacePoint* first = &MemoryMarshal.GetReference(sources))
            fixed (float* begin = &MemoryMarshal.GetReference(offsets))
            fixed (int* chosen = &MemoryMarshal.GetReference(nearest))
            fixed (float* results = &MemoryMarshal.GetReference(distances))
                NativeMethods.geoidx_query_point_nearest_sources(
                    handle, HandleOf(surface), first, (uint)sources.Length, offsets.IsEmpty ? null : begin, chosen,
                    distances.IsEmpty ? null : results, (uint)nearest.Length).ThrowIfError();
        }

        /// <summary>
        /// The vertices that are no farther than a radius from the nearest of some points of the surface, the nearest
        /// first.
        /// </summary>
        /// <param name="surface">Of the index's mesh.</param>
        /// <param name="sources">One or more points.</param>
        /// <param name="offsets">A distance for each source to begin with, or empty.</param>
        /// <param name="radius">0 or more, in the mesh's unit.</param>
        /// <param name="vertices">
        /// Takes as many of the vertices as it has room for, the nearest ones; may be empty.
        /// </param>
        /// <param name="distances">
        /// As long as <paramref name="vertices"/>, or empty; takes how far each vertex is, in the mesh's unit.
        /// </param>
        /// <returns>How many vertices are within the radius, which may be more than there is room for.</returns>
        /// <exception cref="GeodesicArgumentException">
        /// A point is not on the surface, or the radius or a number of offsets or distances is wrong.
        /// </exception>
        /// <exception cref="GeodesicMeshMismatchException">The surface is that of another mesh.</exception>
        public unsafe int Within(
            GeodesicSurface surface, ReadOnlySpan<SurfacePoint> sources, ReadOnlySpan<float> offsets, float radius,
            Span<int> vertices, Span<float> distances = default)
        {
            CheckOffsets(offsets, sources.Length);
            if (!distances.IsEmpty) Lengths.CheckEqual(vertices.Length, distances.Length);
            using SingleUse.Scope scope = use.Begin();
            uint count;
            fixed (SurfacePoint* first = &MemoryMarshal.GetReference(sources))
            fixed (float* begin = &MemoryMarshal.GetReference(offsets))
            fixed (int* found = &MemoryMarshal.GetReference(vertices))
            fixed (float* results = &MemoryMarshal.GetReference(distances))
                NativeMethods.geoidx_query_point_within(
                    handle, HandleOf(surface), first, (uint)sources.Length, offsets.IsEmpty ? null : begin, radius,
                    found, distances.IsEmpty ? null : results, (uint)vertices.Length, out count).ThrowIfError();
            return (int)count;
        }

        /// <summary>The nearest of some points of the surface to another one, the nearest first.</summary>
        /// <param name="surface">Of the index's mesh.</param>
        /// <param name="source">The point that they are near to.</param>
        /// <param name="targets">The points.</param>
        /// <param name="positions">
        /// Takes the positions in <paramref name="targets"/> of as many targets as it has room for.
        /// </param>
        /// <param name="distances">
        /// As long as <paramref name="positions"/>, or empty; takes how far each of them is, in the mesh's unit.
        /// </param>
        /// <returns>
        /// How many targets there are: fewer than there is room for only if no more of them can be reached.
        /// </returns>
        /// <exception cref="GeodesicArgumentException">
        /// A point is not on the surface, or the number of distances is wrong.
        /// </exception>
        /// <exception cref="GeodesicMeshMismatchException">The surface is that of another mesh.</exception>
        public unsafe int NearestTargets(
            GeodesicSurface surface, SurfacePoint source, ReadOnlySpan<SurfacePoint> targets, Span<int> positions,
            Span<float> distances = default)
        {
            if (!distances.IsEmpty) Lengths.CheckEqual(positions.Length, distances.Length);
            using SingleUse.Scope scope = use.Begin();
            uint count;
            fixed (SurfacePoint* first = &MemoryMarshal.GetReference(targets))
            fixed (int* chosen = &MemoryMarshal.GetReference(positions))
            fixed (float* results = &MemoryMarshal.GetReference(distances))
                NativeMethods.geoidx_query_point_nearest_targets(
                    handle, HandleOf(surface), &source, first, (uint)targets.Length, chosen,
                    distances.IsEmpty ? null : results, (uint)positions.Length, out count).ThrowIfError();
            return (int)count;
        }

        private static void CheckOffsets(ReadOnlySpan<float> offsets, int sources)
        {
            if (!offsets.IsEmpty && offsets.Length != sources)
                throw new GeodesicArgumentException(
                    $"offsets.Length is {offsets.Length}, but there are {sources} sources");
        }
    }
}
