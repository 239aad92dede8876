using System;
using System.Buffers;
using System.Collections.Generic;
using static Geoidx.Arguments;

namespace Geoidx
{
    /// <summary>Options of a build as the native library takes them, their arrays held in place.</summary>
    internal sealed unsafe class PinnedBuildOptions : IDisposable
    {
        private readonly List<MemoryHandle> pins = new List<MemoryHandle>();

        internal PinnedBuildOptions(BuildOptions? options, BuildCallbacks callbacks)
        {
            NativeBuildOptions native = NativeDefaults.BuildOptions();
            if (options != null)
            {
                CopyNumbers(options, ref native);
                CopyPatches(options.Patches.ToArray(), ref native);
                PinAll(options, ref native);
            }
            callbacks.Register(ref native);
            Native = native;
        }

        internal NativeBuildOptions Native { get; }

        public void Dispose()
        {
            foreach (MemoryHandle pin in pins) pin.Dispose();
        }

        private static void CopyNumbers(BuildOptions options, ref NativeBuildOptions native)
        {
            native.metric = (uint)options.Metric;
            native.metric_flags = (uint)options.MetricFlags;
            native.engine = (uint)options.Engine;
            native.weld_tolerance = options.WeldTolerance;
            native.delta = options.Delta;
            native.seed = options.Seed;
            native.threads = NotNegative(options.Threads, nameof(options.Threads));
            native.level_count = NotNegative(options.LevelCount, nameof(options.LevelCount));
            native.lloyd_iterations = NotNegative(options.LloydIterations, nameof(options.LloydIterations));
            native.points_per_edge = NotNegative(options.PointsPerEdge, nameof(options.PointsPerEdge));
            native.exact_vertices = NotNegative(options.ExactVertices, nameof(options.ExactVertices));
            native.rounding = options.Rounding;
            native.target_error = options.TargetError;
            native.store_mesh = options.StoreMesh ? 1u : 0u;
            native.solver_tolerance = options.SolverTolerance;
            native.refuse_edges_of_many = options.RefuseEdgesOfMany ? 1u : 0u;
        }

        private static void CopyPatches(int[] patches, ref NativeBuildOptions native)
        {
            if (patches.Length > BuildOptions.MaxLevels)
                throw new GeodesicArgumentException(
                    $"Patches are given for {patches.Length} levels, at most {BuildOptions.MaxLevels} are possible.");
            for (int level = 0; level < patches.Length; level++)
                native.patches[level] = NotNegative(patches[level], nameof(BuildOptions.Patches));
        }

        // Nobody disposes of an object whose constructor throws.
        private void PinAll(BuildOptions options, ref NativeBuildOptions native)
        {
            try
            {
                PinArrays(options, ref native);
            }
            catch
            {
                Dispose();
                throw;
            }
        }

        private void PinArrays(BuildOptions options, ref NativeBuildOptions native)
        {
            if (options.EdgeCostVertices.Length != 2L * options.EdgeCosts.Length)
                throw new GeodesicArgumentException(
                    $"{options.EdgeCostVertices.Length} vertices do not name {options.EdgeCosts.Length} edges.");
            native.edge_cost_count = (uint)options.EdgeCosts.Length;
            native.edge_cost_vertices = (int*)Pin(options.EdgeCostVertices);
            native.edge_costs = (double*)Pin(options.EdgeCosts);
            native.face_cost_count = (ulong)options.FaceCosts.Length;
            native.face_costs = (double*)Pin(options.FaceCosts);
            native.edge_length_count = (ulong)options.EdgeLengths.Length;
            native.edge_lengths = (double*)Pin(options.EdgeLengths);
        }

        private void* Pin<T>(ReadOnlyMemory<T> memory)
        {
            if (memory.IsEmpty) return null;
            MemoryHandle pin = memory.Pin();
            pins.Add(pin);
            return pin.Pointer;
        }
    }
}
