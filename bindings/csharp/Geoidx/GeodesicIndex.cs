using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using System.Threading;

namespace Geoidx
{
    /// <summary>
    /// Precomputed geodesic distances of a mesh. An index is immutable: any number of threads may use it at once.
    /// Distances are in the mesh's own unit, infinite to a vertex that cannot be reached. Vertices are positions in the
    /// array that the index was built from.
    /// </summary>
    public sealed partial class GeodesicIndex : IDisposable
    {
        private readonly IndexHandle handle;
        private volatile bool isDisposed;

        private GeodesicIndex(IndexHandle handle)
        {
            this.handle = handle;
            Info = ReadInfo();
            Sections = ReadSections();
        }

        /// <summary>What the index is and how exact.</summary>
        public GeodesicInfo Info { get; }

        /// <summary>
        /// The sections of the file that the index was opened from, in the order of the file; an index that was built
        /// has none.
        /// </summary>
        public IReadOnlyList<GeodesicSection> Sections { get; }

        /// <summary>Vertices of the caller's array.</summary>
        public int VertexCount => checked((int)Info.VertexCount);

        // The queries' leases keep the native index open beyond Dispose.
        internal IndexHandle Handle =>
            isDisposed ? throw new ObjectDisposedException(nameof(GeodesicIndex)) : handle;

        /// <summary>Builds the index of a mesh.</summary>
        /// <param name="mesh">The mesh; its arrays are not needed afterwards.</param>
        /// <param name="options">Null: the defaults.</param>
        /// <param name="progress">
        /// Is told the fraction that is done, 0 to 1, on this thread. What it throws stops the build and is thrown on.
        /// </param>
        /// <param name="cancellationToken">Stops the build, within a fraction of a second.</param>
        /// <exception cref="OperationCanceledException">
        /// The build was cancelled, or its AppDomain or the program ended.
        /// </exception>
        /// <exception cref="ArgumentOutOfRangeException">A number of the options is negative.</exception>
        /// <exception cref="GeodesicException">The status says what failed, the message where.</exception>
        public static GeodesicIndex Build(
            GeodesicMesh mesh,
            BuildOptions? options = null,
            IProgress<float>? progress = null,
            CancellationToken cancellationToken = default)
        {
            if (mesh == null) throw new ArgumentNullException(nameof(mesh));
            GeodesicLibrary.Load();
            using PinnedMesh pinned = mesh.Pin();
            return Build(pinned.Native, options, progress, cancellationToken);
        }

        /// <inheritdoc cref="Build(GeodesicMesh, BuildOptions?, IProgress{float}?, CancellationToken)"/>
        /// <typeparam name="TVertex">
        /// float or double: x, y and z of a vertex are three elements. Any other struct is one vertex and begins with
        /// its position, three floats.
        /// </typeparam>
        /// <param name="positions">Of the vertices, in the mesh's own unit.</param>
        /// <param name="triangles">Three vertices a triangle.</param>
        /// <param name="options">Null: the defaults.</param>
        /// <param name="progress">
        /// Is told the fraction that is done, 0 to 1, on this thread. What it throws stops the build and is thrown on.
        /// </param>
        /// <param name="cancellationToken">Stops the build, within a fraction of a second.</param>
        public static unsafe GeodesicIndex Build<TVertex>(
            ReadOnlySpan<TVertex> positions,
            ReadOnlySpan<int> triangles,
            BuildOptions? options = null,
            IProgress<float>? progress = null,
            CancellationToken cancellationToken = default) where TVertex : unmanaged
        {
            GeodesicLibrary.Load();
            NativeMesh mesh =
                MeshLayout.Of<TVertex>(null).Describe(positions.Length, triangles.Length);
            fixed (TVertex* first = &MemoryMarshal.GetReference(positions))
            fixed (int* corners = &MemoryMarshal.GetReference(triangles))
            {
                mesh.positions = first;
                mesh.triangles = corners;
                return Build(mesh, options, progress, cancellationToken);
            }
        }

        /// <summary>The distance between two vertices (SSSD), the same in both directions.</summary>
        /// <exception cref="GeodesicArgumentException">A vertex is out of range.</exception>
        /// <exception cref="ObjectDisposedException">The index is disposed.</exception>
        public float Distance(int source, int target)
        {
            NativeMethods.geoidx_sssd(Handle, source, target, out float distance).ThrowIfError();
            return distance;
        }

        /// <summary>The distance of each pair; many at once take less time each.</summary>
        /// <param name="pairs">Vertices.</param>
        /// <param name="distances">
        /// As long as <paramref name="pairs"/>; takes the distances, in the mesh's unit.
        /// </param>
        /// <exception cref="GeodesicArgumentException">A vertex is out of range; nothing is written.</exception>
        public unsafe void Distances(ReadOnlySpan<VertexPair> pairs, Span<float> distances)
        {
            Lengths.CheckEqual(pairs.Length, distances.Length);
            fixed (VertexPair* first = &MemoryMarshal.GetReference(pairs))
            fixed (float* results = &MemoryMarshal.GetReference(distances))
                NativeMethods.geoidx_sssd_batch(Handle, first, (ulong)pairs.Length, results).ThrowIfError();
        }

        /// <summary>The distance of each pair, in the mesh's unit; many at once take less time each.</summary>
        public float[] Distances(params VertexPair[] pairs)
        {
            if (pairs == null) throw new ArgumentNullException(nameof(pairs));
            var distances = new float[pairs.Length];
            Distances(pairs, distances);
            return distances;
        }

        /// <summary>The distance of every vertex to the nearest source (MSAD).</summary>
        /// <param name="sources">One or more vertices.</param>
        /// <param name="distances">One for each vertex, in the mesh's unit.</param>
        /// <exception cref="GeodesicArgumentException">A source or the number of distances is wrong.</exception>
        public unsafe void FromSources(ReadOnlySpan<int> sources, Span<float> distances)
        {
            fixed (int* first = &MemoryMarshal.GetReference(sources))
            fixed (float* results = &MemoryMarshal.GetReference(distances))
                NativeMethods.geoidx_msad(Handle, first, (uint)sources.Length, results, (uint)distances.Length)
                    .ThrowIfError();
        }

        /// <summary>The distance of every vertex to the nearest source (MSAD), in the mesh's unit.</summary>
        public float[] FromSources(params int[] sources)
        {
            if (sources == null) throw new ArgumentNullException(nameof(sources));
            var distances = new float[VertexCount];
            FromSources(sources, distances);
            return distances;
        }

        /// <summary>The distances from each source to every vertex (SSAD of each).</summary>
        /// <param name="sources">Vertices; of none there is nothing to fill.</param>
        /// <param name="distances">
        /// For each source one for each vertex, in the mesh's unit: that from sources[i] to v at i * VertexCount + v.
        /// </param>
        /// <exception cref="GeodesicArgumentException">A source or the number of distances is wrong.</exception>
        public unsafe void FromEachSource(ReadOnlySpan<int> sources, Span<float> distances)
        {
            fixed (int* first = &MemoryMarshal.GetReference(sources))
            fixed (float* results = &MemoryMarshal.GetReference(distances))
                NativeMethods.geoidx_ssad_batch(Handle, first, (uint)sources.Length, results, (ulong)distances.Length)
                    .ThrowIfError();
        }

        /// <summary>
        /// The distances from each source to every vertex, in the mesh's unit: that from sources[i] to v at
        /// i * VertexCount + v.
        /// </summary>
        public float[] FromEachSource(params int[] sources)
        {
            if (sources == null) throw new ArgumentNullException(nameof(sources));
            var distances = new float[checked(sources.Length * VertexCount)];
            FromEachSource(sources, distances);
            return distances;
        }

        /// <summary>The distance from every source to every target.</summary>
        /// <remarks>
        /// Each is as <see cref="Distance"/> gives it, or as
        /// <see cref="FromEachSource(ReadOnlySpan{int}, Span{float})"/> gives it from the source or from the target,
        /// whichever takes least time for all of them. They differ by the error of the index.
        /// </remarks>
        /// <param name="sources">Vertices.</param>
        /// <param name="targets">Vertices.</param>
        /// <param name="distances">
        /// For each source one for each target, in the mesh's unit: that from sources[i] to targets[j] at
        /// i * targets.Length + j.
        /// </param>
        /// <exception cref="GeodesicArgumentException">
        /// A vertex is out of range, or the number of distances is wrong; nothing is written.
        /// </exception>
        public unsafe void Matrix(ReadOnlySpan<int> sources, ReadOnlySpan<int> targets, Span<float> distances)
        {
            fixed (int* first = &MemoryMarshal.GetReference(sources))
            fixed (int* firstTarget = &MemoryMarshal.GetReference(targets))
            fixed (float* results = &MemoryMarshal.GetReference(distances))
                NativeMethods.geoidx_matrix(
                    Handle, first, (uint)sources.Length, firstTarget, (uint)targets.Length, results,
                    (ulong)distances.Length).ThrowIfError();
        }

        /// <summary>
        /// The distance from every source to every target, in the mesh's unit: that from sources[i] to targets[j] at
        /// i * targets.Length + j.
        /// </summary>
        /// <inheritdoc cref="Matrix(ReadOnlySpan{int}, ReadOnlySpan{int}, Span{float})" path="/remarks"/>
        public float[] Matrix(int[] sources, int[] targets)
        {
            if (sources == null) throw new ArgumentNullException(nameof(sources));
            if (targets == null) throw new ArgumentNullException(nameof(targets));
            var distances = new float[checked(sources.Length * targets.Length)];
            Matrix(sources, targets, distances);
            return distances;
        }

        /// <summary>One thread's scratch for queries, which neither lock nor, after the first ones, allocate.</summary>
        public GeodesicQuery CreateQuery() => new GeodesicQuery(QueryHandle.Create(Handle), VertexCount);

        /// <summary>
        /// From then on every call of the index throws <see cref="ObjectDisposedException"/>; <see cref="Info"/>,
        /// <see cref="Sections"/> and <see cref="VertexCount"/> stay, and its queries go on. The native index is freed
        /// when calls on other threads and the queries are done with it.
        /// </summary>
        public void Dispose()
        {
            isDisposed = true;
            handle.Dispose();
        }

        private static GeodesicIndex Build(
            NativeMesh mesh, BuildOptions? options, IProgress<float>? progress, CancellationToken cancellationToken)
        {
            cancellationToken.ThrowIfCancellationRequested();
            using var callbacks = new BuildCallbacks(options, progress, cancellationToken);
            return new GeodesicIndex(IndexHandle.Build(mesh, options, callbacks));
        }

        private unsafe GeodesicInfo ReadInfo()
        {
            var native = new NativeInfo { struct_size = (uint)sizeof(NativeInfo) };
            NativeMethods.geoidx_get_info(handle, &native).ThrowIfError();
            return new GeodesicInfo(native);
        }

        private unsafe GeodesicSection[] ReadSections()
        {
            NativeMethods.geoidx_get_sections(handle, null, 0, out uint count).ThrowIfError();
            var native = new NativeSection[count];
            fixed (NativeSection* first = native)
                NativeMethods.geoidx_get_sections(handle, first, count, out _).ThrowIfError();
            return Array.ConvertAll(native, section => new GeodesicSection(section));
        }
    }
}
