using System;
using System.Runtime.InteropServices;

namespace Geoidx
{
    /// <summary>
    /// Distances under the metric itself, computed from scratch, without an index. Each thread needs its own: a call
    /// during another one throws <see cref="InvalidOperationException"/>. One whose
    /// <see cref="BuildOptions.MetricCallback"/> reaches the solver itself must be disposed: no finalizer does it.
    /// </summary>
    public sealed class GeodesicSolver : IDisposable
    {
        private readonly SolverHandle handle;
        private readonly SingleUse use = new SingleUse();

        /// <summary>Makes a mesh and a metric ready to compute.</summary>
        /// <param name="mesh">The mesh; its arrays are not needed afterwards.</param>
        /// <param name="options">
        /// The metric, what belongs to it, <see cref="BuildOptions.WeldTolerance"/>,
        /// <see cref="BuildOptions.RefuseEdgesOfMany"/> and <see cref="BuildOptions.SolverTolerance"/>; the others
        /// are not used; a negative number among those that must not be negative is still refused. Null: the defaults.
        /// </param>
        /// <exception cref="GeodesicException">The status says what failed, the message where.</exception>
        public GeodesicSolver(GeodesicMesh mesh, BuildOptions? options = null)
        {
            if (mesh == null) throw new ArgumentNullException(nameof(mesh));
            GeodesicLibrary.Load();
            using PinnedMesh pinned = mesh.Pin();
            handle = SolverHandle.Create(pinned.Native, options);
            VertexCount = checked((int)pinned.Native.vertex_count);
        }

        /// <summary>Vertices of the caller's array.</summary>
        public int VertexCount { get; }

        /// <summary>The distance between two vertices, in the mesh's unit.</summary>
        public unsafe double Distance(int source, int target)
        {
            double distance;
            Solve(new ReadOnlySpan<int>(&source, 1), &target, 1, &distance);
            return distance;
        }

        /// <summary>The distance of each target to the nearest source; ends when all targets are reached.</summary>
        /// <param name="sources">One or more vertices.</param>
        /// <param name="targets">Vertices.</param>
        /// <param name="distances">
        /// As long as <paramref name="targets"/>; takes the distances, in the mesh's unit.
        /// </param>
        /// <exception cref="GeodesicArgumentException">A vertex is out of range.</exception>
        public unsafe void Distances(ReadOnlySpan<int> sources, ReadOnlySpan<int> targets, Span<double> distances)
        {
            Lengths.CheckEqual(targets.Length, distances.Length);
            if (targets.IsEmpty)
            {
                handle.CheckOpen();
                return;
            }
            fixed (int* asked = &MemoryMarshal.GetReference(targets))
            fixed (double* results = &MemoryMarshal.GetReference(distances))
                Solve(sources, asked, targets.Length, results);
        }

        /// <summary>The distance of every vertex to the nearest source.</summary>
        /// <param name="sources">One or more vertices.</param>
        /// <param name="distances">One for each vertex, in the mesh's unit.</param>
        /// <exception cref="GeodesicArgumentException">A source or the number of distances is wrong.</exception>
        public unsafe void FromSources(ReadOnlySpan<int> sources, Span<double> distances)
        {
            handle.CheckOpen();
            if (distances.Length != VertexCount)
                throw new GeodesicArgumentException(
                    $"distances.Length is {distances.Length}, but the mesh has {VertexCount} vertices");
            fixed (double* results = &MemoryMarshal.GetReference(distances))
                Solve(sources, null, distances.Length, results);
        }

        /// <summary>The distance of every vertex to the nearest source, in the mesh's unit.</summary>
        public double[] FromSources(params int[] sources)
        {
            if (sources == null) throw new ArgumentNullException(nameof(sources));
            var distances = new double[VertexCount];
            FromSources(sources, distances);
            return distances;
        }

        /// <summary>The distance of each target to the nearest source, which are points of the surface.</summary>
        /// <param name="sources">One or more points.</param>
        /// <param name="targets">Points.</param>
        /// <param name="distances">
        /// As long as <paramref name="targets"/>; takes the distances, in the mesh's unit.
        /// </param>
        /// <exception cref="GeodesicArgumentException">
        /// A point is not on the surface, or the metric is neither <see cref="MetricKind.Exact"/> nor
        /// <see cref="MetricKind.Weighted"/>.
        /// </exception>
        public unsafe void PointDistances(
            ReadOnlySpan<SurfacePoint> sources, ReadOnlySpan<SurfacePoint> targets, Span<double> distances)
        {
            Lengths.CheckEqual(targets.Length, distances.Length);
            using SingleUse.Scope scope = use.Begin();
            using CallsInFlight.Call call = CallsInFlight.BeginCall();
            fixed (SurfacePoint* from = &MemoryMarshal.GetReference(sources))
            fixed (SurfacePoint* to = &MemoryMarshal.GetReference(targets))
            fixed (double* results = &MemoryMarshal.GetReference(distances))
                handle.Check(NativeMethods.geoidx_solver_point_distances(
                    handle, from, (uint)sources.Length, to, (uint)targets.Length, results));
        }

        /// <summary>Frees the solver.</summary>
        public void Dispose() => handle.Dispose();

        private unsafe void Solve(ReadOnlySpan<int> sources, int* targets, int targetCount, double* distances)
        {
            using SingleUse.Scope scope = use.Begin();
            using CallsInFlight.Call call = CallsInFlight.BeginCall();
            fixed (int* first = &MemoryMarshal.GetReference(sources))
                handle.Check(NativeMethods.geoidx_solver_distances(
                    handle, first, (uint)sources.Length, targets, (uint)targetCount, distances));
        }
    }
}
