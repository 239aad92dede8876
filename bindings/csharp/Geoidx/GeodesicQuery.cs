using System;
using System.Runtime.InteropServices;

namespace Geoidx
{
    /// <summary>
    /// One thread's scratch for queries on one index, made by <see cref="GeodesicIndex.CreateQuery"/>. Each thread
    /// needs its own: a call during another one throws <see cref="InvalidOperationException"/>. It keeps the native
    /// index until it is disposed, also when the <see cref="GeodesicIndex"/> is disposed before.
    /// </summary>
    public sealed partial class GeodesicQuery : IDisposable
    {
        private readonly QueryHandle handle;
        private readonly SingleUse use = new SingleUse();

        internal GeodesicQuery(QueryHandle handle, int vertexCount)
        {
            this.handle = handle;
            VertexCount = vertexCount;
        }

        /// <summary>Vertices of the caller's array.</summary>
        public int VertexCount { get; }

        internal IntPtr NativeHandle => handle.DangerousGetHandle();

        /// <inheritdoc cref="GeodesicIndex.Distance"/>
        public float Distance(int source, int target)
        {
            using SingleUse.Scope scope = use.Begin();
            NativeMethods.geoidx_query_sssd(handle, source, target, out float distance).ThrowIfError();
            return distance;
        }

        /// <inheritdoc cref="GeodesicIndex.FromSources(ReadOnlySpan{int}, Span{float})"/>
        public unsafe void FromSources(ReadOnlySpan<int> sources, Span<float> distances)
        {
            using SingleUse.Scope scope = use.Begin();
            fixed (int* first = &MemoryMarshal.GetReference(sources))
            fixed (float* results = &MemoryMarshal.GetReference(distances))
                NativeMethods.geoidx_query_msad(handle, first, (uint)sources.Length, results, (uint)distances.Length)
                    .ThrowIfError();
        }

        /// <summary>
        /// The distance of every vertex to the nearest source (MSAD), infinite beyond <paramref name="radius"/>,
        /// which saves time.
        /// </summary>
        /// <param name="sources">One or more vertices.</param>
        /// <param name="radius">0 or more, in the mesh's unit.</param>
        /// <param name="distances">One for each vertex, in the mesh's unit.</param>
        /// <exception cref="GeodesicArgumentException">
        /// A source, the radius or the number of distances is wrong.
        /// </exception>
        public unsafe void FromSourcesWithin(ReadOnlySpan<int> sources, float radius, Span<float> distances)
        {
            using SingleUse.Scope scope = use.Begin();
            fixed (int* first = &MemoryMarshal.GetReference(sources))
            fixed (float* results = &MemoryMarshal.GetReference(distances))
                NativeMethods.geoidx_query_msad_within(
                    handle, first, (uint)sources.Length, radius, results, (uint)distances.Length).ThrowIfError();
        }

        /// <summary>
        /// Farthest-point sampling: each point is the vertex that is farthest from the sources and from the points
        /// before it.
        /// </summary>
        /// <param name="sources">One or more vertices.</param>
        /// <param name="points">Takes the points.</param>
        /// <param name="distances">
        /// As long as <paramref name="points"/>, or empty; takes how far each point is, in the mesh's unit, infinite
        /// if it is the first one of a component.
        /// </param>
        /// <returns>
        /// How many points there are: fewer than there is room for only if all other vertices are at distance 0 of a
        /// source or of a point.
        /// </returns>
        /// <exception cref="GeodesicArgumentException">A source or the number of distances is wrong.</exception>
        public unsafe int FarthestPoints(
            ReadOnlySpan<int> sources, Span<int> points, Span<float> distances = default)
        {
            if (!distances.IsEmpty) Lengths.CheckEqual(points.Length, distances.Length);
            using SingleUse.Scope scope = use.Begin();
            uint count;
            fixed (int* first = &MemoryMarshal.GetReference(sources))
            fixed (int* chosen = &MemoryMarshal.GetReference(points))
            fixed (float* results = &MemoryMarshal.GetReference(distances))
                NativeMethods.geoidx_query_farthest_points(
                    handle, first, (uint)sources.Length, (uint)points.Length, chosen,
                    distances.IsEmpty ? null : results, out count).ThrowIfError();
            return (int)count;
        }

        /// <inheritdoc cref="GeodesicIndex.FromEachSource(ReadOnlySpan{int}, Span{float})"/>
        public unsafe void FromEachSource(ReadOnlySpan<int> sources, Span<float> distances)
        {
            using SingleUse.Scope scope = use.Begin();
            fixed (int* first = &MemoryMarshal.GetReference(sources))
            fixed (float* results = &MemoryMarshal.GetReference(distances))
                NativeMethods.geoidx_query_ssad_batch(
                    handle, first, (uint)sources.Length, results, (ulong)distances.Length).ThrowIfError();
        }

        /// <inheritdoc cref="GeodesicIndex.Matrix(ReadOnlySpan{int}, ReadOnlySpan{int}, Span{float})"/>
        public unsafe void Matrix(ReadOnlySpan<int> sources, ReadOnlySpan<int> targets, Span<float> distances)
        {
            using SingleUse.Scope scope = use.Begin();
            fixed (int* first = &MemoryMarshal.GetReference(sources))
            fixed (int* firstTarget = &MemoryMarshal.GetReference(targets))
            fixed (float* results = &MemoryMarshal.GetReference(distances))
                NativeMethods.geoidx_query_matrix(
                    handle, first, (uint)sources.Length, firstTarget, (uint)targets.Length, results,
                    (ulong)distances.Length).ThrowIfError();
        }

        /// <summary>
        /// Keeps what depends on a source, for <see cref="FromPrepared(ReadOnlySpan{int}, Span{float})"/>, until the
        /// next call of this.
        /// </summary>
        /// <exception cref="GeodesicArgumentException">The vertex is out of range.</exception>
        public void Prepare(int source)
        {
            using SingleUse.Scope scope = use.Begin();
            NativeMethods.geoidx_query_prepare(handle, source).ThrowIfError();
        }

        /// <summary>The distances from the prepared source to targets.</summary>
        /// <param name="targets">Vertices.</param>
        /// <param name="distances">
        /// As long as <paramref name="targets"/>; takes the distances, in the mesh's unit.
        /// </param>
        /// <exception cref="GeodesicArgumentException">A vertex is out of range, or no source is prepared.</exception>
        public unsafe void FromPrepared(ReadOnlySpan<int> targets, Span<float> distances)
        {
            Lengths.CheckEqual(targets.Length, distances.Length);
            using SingleUse.Scope scope = use.Begin();
            fixed (int* first = &MemoryMarshal.GetReference(targets))
            fixed (float* results = &MemoryMarshal.GetReference(distances))
                NativeMethods.geoidx_query_prepared(handle, first, (ulong)targets.Length, results).ThrowIfError();
        }

        /// <summary>The distance from the prepared source to a target, in the mesh's unit.</summary>
        /// <exception cref="GeodesicArgumentException">
        /// The vertex is out of range, or no source is prepared.
        /// </exception>
        public unsafe float FromPrepared(int target)
        {
            float distance;
            FromPrepared(new ReadOnlySpan<int>(&target, 1), new Span<float>(&distance, 1));
            return distance;
        }

        /// <summary>
        /// From then on <see cref="FromSources"/>, <see cref="FromSourcesWithin"/>, <see cref="FromPoints"/>,
        /// <c>NearestSources</c> and <see cref="FarthestPoints"/> use so many threads, which begin and end
        /// within each call, for the same answers.
        /// </summary>
        /// <param name="threads">1 at first; 0 means one per processor; at most 1024.</param>
        /// <exception cref="ArgumentOutOfRangeException">These are fewer than 0.</exception>
        /// <exception cref="GeodesicArgumentException">These are too many.</exception>
        public void SetThreads(int threads)
        {
            uint count = Arguments.NotNegative(threads, nameof(threads));
            using SingleUse.Scope scope = use.Begin();
            NativeMethods.geoidx_query_set_threads(handle, count).ThrowIfError();
        }

        /// <summary>Frees the scratch, and the native index if this was its last use.</summary>
        public void Dispose() => handle.Dispose();
    }
}
