using System;
using System.Runtime.InteropServices;

namespace Geoidx
{
    /// <content>Which sources, vertices or targets are nearest.</content>
    public sealed partial class GeodesicQuery
    {
        /// <summary>What <c>NearestSources</c> writes for a vertex that no source reaches.</summary>
        public const int NoSource = -1;

        /// <summary>The nearest source to every vertex.</summary>
        /// <remarks>
        /// Of several sources that are as near, it is one whose choice depends on the index alone; of a vertex that is
        /// repeated, the first. A source that is nearer than every other one by more than the error of the index is the
        /// one that is found.
        /// </remarks>
        /// <param name="sources">One or more vertices.</param>
        /// <param name="nearest">
        /// One for each vertex; takes the position of its nearest source in <paramref name="sources"/>, or
        /// <see cref="NoSource"/> where no source is reached.
        /// </param>
        /// <param name="distances">
        /// As long as <paramref name="nearest"/>, or empty; takes how far the nearest source is, in the mesh's unit, as
        /// <see cref="FromSources"/> does.
        /// </param>
        /// <exception cref="GeodesicArgumentException">
        /// A source, the number of vertices or the number of distances is wrong.
        /// </exception>
        public unsafe void NearestSources(
            ReadOnlySpan<int> sources, Span<int> nearest, Span<float> distances = default)
        {
            Lengths.CheckEqual(VertexCount, nearest.Length, nameof(nearest));
            if (!distances.IsEmpty) Lengths.CheckEqual(nearest.Length, distances.Length);
            using SingleUse.Scope scope = use.Begin();
            fixed (int* first = &MemoryMarshal.GetReference(sources))
            fixed (int* chosen = &MemoryMarshal.GetReference(nearest))
            fixed (float* results = &MemoryMarshal.GetReference(distances))
                NativeMethods.geoidx_query_nearest_sources(
                    handle, first, (uint)sources.Length, chosen, distances.IsEmpty ? null : results,
                    (uint)nearest.Length).ThrowIfError();
        }

        /// <summary>
        /// The vertices that are no farther than a radius from the nearest source, the nearest first, of those that are
        /// as near the one with the least number.
        /// </summary>
        /// <remarks>
        /// From one source the distances are those of <see cref="FromSourcesWithin"/>; from several they are the least
        /// of those from each.
        /// </remarks>
        /// <param name="sources">One or more vertices.</param>
        /// <param name="radius">0 or more, in the mesh's unit.</param>
        /// <param name="vertices">
        /// Takes as many of the vertices as it has room for, the nearest ones; may be empty.
        /// </param>
        /// <param name="distances">
        /// As long as <paramref name="vertices"/>, or empty; takes how far each vertex is, in the mesh's unit.
        /// </param>
        /// <returns>How many vertices are within the radius, which may be more than there is room for.</returns>
        /// <exception cref="GeodesicArgumentException">
        /// A source, the radius or the number of distances is wrong.
        /// </exception>
        public unsafe int Within(
            ReadOnlySpan<int> sources, float radius, Span<int> vertices, Span<float> distances = default)
        {
            if (!distances.IsEmpty) Lengths.CheckEqual(vertices.Length, distances.Length);
            using SingleUse.Scope scope = use.Begin();
            uint count;
            fixed (int* first = &MemoryMarshal.GetReference(sources))
            fixed (int* found = &MemoryMarshal.GetReference(vertices))
            fixed (float* results = &MemoryMarshal.GetReference(distances))
                NativeMethods.geoidx_query_within(
                    handle, first, (uint)sources.Length, radius, found, distances.IsEmpty ? null : results,
                    (uint)vertices.Length, out count).ThrowIfError();
            return (int)count;
        }

        /// <summary>
        /// The nearest of some targets, the nearest first, of those that are as near the one that comes first.
        /// </summary>
        /// <param name="source">A vertex.</param>
        /// <param name="targets">Vertices.</param>
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
        /// A vertex is out of range, or the number of distances is wrong.
        /// </exception>
        public unsafe int NearestTargets(
            int source, ReadOnlySpan<int> targets, Span<int> positions, Span<float> distances = default)
        {
            if (!distances.IsEmpty) Lengths.CheckEqual(positions.Length, distances.Length);
            using SingleUse.Scope scope = use.Begin();
            uint count;
            fixed (int* first = &MemoryMarshal.GetReference(targets))
            fixed (int* chosen = &MemoryMarshal.GetReference(positions))
            fixed (float* results = &MemoryMarshal.GetReference(distances))
                NativeMethods.geoidx_query_nearest_targets(
                    handle, source, first, (uint)targets.Length, chosen, distances.IsEmpty ? null : results,
                    (uint)positions.Length, out count).ThrowIfError();
            return (int)count;
        }
    }
}
