using System;
using System.Runtime.CompilerServices;

namespace Geoidx
{
    /// <summary>Options of a build. New ones have the native library's defaults.</summary>
    public sealed class BuildOptions
    {
        /// <summary>The most levels below the whole mesh.</summary>
        public const int MaxLevels = 8;

        /// <summary>The native library's defaults.</summary>
        public BuildOptions()
        {
            GeodesicLibrary.Load();
            TakeDefaults();
        }

        /// <summary>What a distance is. Default: <see cref="MetricKind.Exact"/>.</summary>
        public MetricKind Metric { get; set; }

        /// <summary>
        /// The metric of <see cref="MetricKind.Callback"/>; read by no other. It is called until the build has returned
        /// or the solver is disposed. A solver holds it: one that the metric can reach is not collected before it is
        /// disposed.
        /// </summary>
        public GeodesicMetric? MetricCallback { get; set; }

        /// <summary>What <see cref="MetricCallback"/> is known to be. Default: symmetric only.</summary>
        public MetricFlags MetricFlags { get; set; }

        /// <summary>How the index answers. Default: <see cref="GeodesicEngine.Overlay"/>.</summary>
        public GeodesicEngine Engine { get; set; }

        /// <summary>
        /// Vertices at most this far apart, in the mesh's unit, are one. Default: 0, equal positions only.
        /// </summary>
        public double WeldTolerance { get; set; }

        /// <summary>The pruning threshold, in % of the bounding-box diagonal, 0 to 100. Default: 0, none.</summary>
        public double Delta { get; set; }

        /// <summary>Of every random choice: the same mesh, options and seed give the same bytes.</summary>
        public ulong Seed { get; set; }

        /// <summary>Threads that build. Default: 0, one per processor.</summary>
        public int Threads { get; set; }

        /// <summary>Levels below the whole mesh, at most <see cref="MaxLevels"/>. Default: 0, automatic.</summary>
        public int LevelCount { get; set; }

        /// <summary>
        /// Into how many patches the whole mesh is split, each of these, and so on; 0 or nothing (the default) means in
        /// proportion to the triangles.
        /// </summary>
        public ReadOnlyMemory<int> Patches { get; set; }

        /// <summary>Relaxations of the patches' seeds, at most 1000. Default: 4.</summary>
        public int LloydIterations { get; set; }

        /// <summary>
        /// <see cref="MetricKind.Edges"/>: two vertices for each edge of <see cref="EdgeCosts"/>. Other edges cost
        /// their length.
        /// </summary>
        public ReadOnlyMemory<int> EdgeCostVertices { get; set; }

        /// <summary>
        /// <see cref="MetricKind.Edges"/>: what passing along each edge of <see cref="EdgeCostVertices"/> costs, finite
        /// and not negative, in the unit that distances then have.
        /// </summary>
        public ReadOnlyMemory<double> EdgeCosts { get; set; }

        /// <summary>
        /// <see cref="MetricKind.Weighted"/>: what a unit of length costs in each triangle of the mesh, positive and
        /// finite.
        /// </summary>
        public ReadOnlyMemory<double> FaceCosts { get; set; }

        /// <summary><see cref="MetricKind.Weighted"/>: points on every edge, 0 to 1000. Default: 12.</summary>
        public int PointsPerEdge { get; set; }

        /// <summary>
        /// <see cref="MetricKind.Exact"/> and <see cref="MetricKind.Weighted"/>: a surface given by lengths, in the
        /// mesh's unit, instead of positions. Three a triangle: the edges opposite to its first, second and third
        /// corner. Default: none.
        /// </summary>
        public ReadOnlyMemory<double> EdgeLengths { get; set; }

        /// <summary>
        /// <see cref="GeodesicEngine.Overlay"/>: tables of patches of up to this many vertices hold the metric's own
        /// distances. Larger is more exact and takes longer to build. Default: 400.
        /// </summary>
        public int ExactVertices { get; set; }

        /// <summary>
        /// <see cref="GeodesicEngine.Overlay"/>: distances are rounded to multiples of this share of the way from a
        /// vertex to the next, 0 to 1, but never to more than 1/8192 of the longest way on the surface around it, and
        /// only to 16 bits in an index of fewer than 65,536 table entries. Default: 1/64, which changes an entry by at
        /// most 0.8 % of the way to the next vertex. 0: to 16 bits only. Twice the share saves one bit of each table
        /// entry in a file that is <see cref="GeodesicCodec.Packed"/>.
        /// </summary>
        public double Rounding { get; set; }

        /// <summary>
        /// <see cref="GeodesicEngine.Overlay"/> with <see cref="MetricKind.Exact"/>, <see cref="Delta"/> 0 and no edge
        /// lengths: the mean error, 0 to 1, that the index is to have at most, where triangles are large also of fields
        /// from points within them, whose p99.9 is to be at most twenty times as much; the index does not state these.
        /// Where it is larger, edges between patches are cut in halves, up to five times, as long as the error becomes
        /// smaller and table entries stay below two and a half times their number without, or 131,072.
        /// Default: 0.0005, which is 0.05 %. 0: no edge is cut.
        /// </summary>
        public double TargetError { get; set; }

        /// <summary>
        /// Whether the index keeps the mesh, so that its file alone is enough for points of the surface and paths
        /// (<see cref="GeodesicSurface(GeodesicIndex)"/>): some 20 bytes a vertex in single precision, 30 in double.
        /// Default: no.
        /// </summary>
        public bool StoreMesh { get; set; }

        /// <summary>
        /// Of a <see cref="GeodesicSolver"/> with <see cref="MetricKind.Exact"/>: by about which share of themselves
        /// distances may be off, 0 to 1e-4, so that they take less time: at 1e-5 fields of scans take 0.6 to 0.9 of it,
        /// those of long triangles a half to a tenth. Default: 0, exact.
        /// </summary>
        public double SolverTolerance { get; set; }

        /// <summary>Whether an edge with more than two triangles makes the mesh unusable. Default: no.</summary>
        public bool RefuseEdgesOfMany { get; set; }

        /// <summary>Is told about fraction and stage, on the thread that builds. Default: nobody.</summary>
        public IProgress<BuildStage>? StageProgress { get; set; }

        /// <summary>Where the index and its queries get memory. Default: the global heap.</summary>
        public IGeodesicAllocator? Allocator { get; set; }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private void TakeDefaults()
        {
            NativeBuildOptions native = NativeDefaults.BuildOptions();
            Metric = (MetricKind)native.metric;
            Engine = (GeodesicEngine)native.engine;
            WeldTolerance = native.weld_tolerance;
            Delta = native.delta;
            Seed = native.seed;
            LloydIterations = (int)native.lloyd_iterations;
            PointsPerEdge = (int)native.points_per_edge;
            ExactVertices = (int)native.exact_vertices;
            Rounding = native.rounding;
            TargetError = native.target_error;
        }
    }
}
