using System;
using System.Collections.Generic;

namespace Geoidx
{
    /// <summary>
    /// What an index is. Errors are of distances from sources to all vertices against the metric itself, |d - exact| /
    /// exact (0.01 is 1 %), from <see cref="ErrorSources"/> seeded random sources, measured when the index was built.
    /// </summary>
    public sealed class GeodesicInfo
    {
        internal unsafe GeodesicInfo(NativeInfo native)
        {
            Metric = (MetricKind)native.metric;
            MetricFlags = (MetricFlags)native.metric_flags;
            MetricFingerprint = native.metric_fingerprint;
            Engine = (GeodesicEngine)native.engine;
            VertexCount = (long)native.vertex_count;
            TriangleCount = (long)native.triangle_count;
            WeldedVertexCount = (long)native.welded_vertex_count;
            MeshFingerprint = native.mesh_fingerprint;
            TableEntries = (long)native.table_entries;
            BorderVertexCount = (long)native.border_vertex_count;
            BoundingBoxDiagonal = native.bounding_box_diagonal;
            Delta = native.delta;
            Seed = native.seed;
            FormatVersion = new Version((int)native.format_major, (int)native.format_minor);
            PatchCounts = Counts(native.patch_count, (int)native.level_count);
            ErrorSources = (int)native.error_sources;
            ErrorMean = native.error_mean;
            ErrorSignedMean = native.error_signed_mean;
            ErrorP99 = native.error_p99;
            ErrorP999 = native.error_p999;
            ErrorMax = native.error_max;
            ErrorMeanAtVertices = native.error_mean_at_vertices;
            Codec = (GeodesicCodec)native.codec;
            HasPositions = (native.file_flags & (uint)SaveFlags.NoPositions) == 0;
            SmallestStep = native.smallest_step;
            LargestStep = native.largest_step;
            AddedVertexCount = (long)native.added_vertex_count;
            ErrorNearMean = native.error_near_mean;
            ErrorNearMax = native.error_near_max;
            ErrorMiddleMean = native.error_middle_mean;
            ErrorMiddleMax = native.error_middle_max;
            ErrorFarMean = native.error_far_mean;
            ErrorFarMax = native.error_far_max;
            ErrorSeveralMean = native.error_several_mean;
            ErrorSeveralMax = native.error_several_max;
            HasMesh = native.has_mesh != 0;
        }

        /// <summary>What a distance is.</summary>
        public MetricKind Metric { get; }

        /// <summary>Properties of the metric.</summary>
        public MetricFlags MetricFlags { get; }

        /// <summary>Of what decides the metric besides the mesh (costs, lengths); 0: nothing.</summary>
        public ulong MetricFingerprint { get; }

        /// <summary>How the index answers.</summary>
        public GeodesicEngine Engine { get; }

        /// <summary>Vertices of the caller's array.</summary>
        public long VertexCount { get; }

        /// <summary>Triangles of the caller's array.</summary>
        public long TriangleCount { get; }

        /// <summary>Distinct vertices, after welding, that a triangle uses.</summary>
        public long WeldedVertexCount { get; }

        /// <summary>Of the caller's arrays.</summary>
        public ulong MeshFingerprint { get; }

        /// <summary>Distances in all tables.</summary>
        public long TableEntries { get; }

        /// <summary>Vertices on a border of the last level, after pruning.</summary>
        public long BorderVertexCount { get; }

        /// <summary>In the mesh's unit.</summary>
        public double BoundingBoxDiagonal { get; }

        /// <summary>The pruning threshold, in % of the bounding-box diagonal.</summary>
        public double Delta { get; }

        /// <summary>Of every random choice of the build.</summary>
        public ulong Seed { get; }

        /// <summary>Of the file.</summary>
        public Version FormatVersion { get; }

        /// <summary>Patches of each level below the whole mesh.</summary>
        public IReadOnlyList<int> PatchCounts { get; }

        /// <summary>How many sources the errors were measured from.</summary>
        public int ErrorSources { get; }

        /// <summary>The mean relative error.</summary>
        public double ErrorMean { get; }

        /// <summary>The mean relative error with its sign: negative where distances are too short.</summary>
        public double ErrorSignedMean { get; }

        /// <summary>The relative error that 1 % of the distances exceed.</summary>
        public double ErrorP99 { get; }

        /// <summary>The relative error that 0.1 % of the distances exceed.</summary>
        public double ErrorP999 { get; }

        /// <summary>The largest relative error that is expected from one source, by MSAD or SSSD; no less than was found.</summary>
        public double ErrorMax { get; }

        /// <summary>What the mean relative error would be if paths crossed borders at vertices only.</summary>
        public double ErrorMeanAtVertices { get; }

        /// <summary>
        /// The form of the file that the index was opened from; of one that was built, what it is saved as by default.
        /// </summary>
        public GeodesicCodec Codec { get; }

        /// <summary>
        /// Whether the file that the index was opened from has the positions of vertices; true of one that was built.
        /// </summary>
        public bool HasPositions { get; }

        /// <summary>
        /// What the distances of a table are multiples of, in the mesh's unit, for the table with the smallest steps;
        /// half of it is the most that rounding changes an entry by. 0 for <see cref="GeodesicEngine.Graph"/>, whose
        /// distances are floats.
        /// </summary>
        public double SmallestStep { get; }

        /// <summary>As <see cref="SmallestStep"/>, for the table with the largest steps.</summary>
        public double LargestStep { get; }

        /// <summary>
        /// Vertices of the tables that have no id and are in no answer, see <see cref="BuildOptions.TargetError"/>.
        /// </summary>
        public long AddedVertexCount { get; }

        /// <summary>
        /// The mean relative error of MSAD from random sources over near distances, which are up to 10 average edges of
        /// the mesh; 0 where there are none.
        /// </summary>
        public double ErrorNearMean { get; }

        /// <summary>The largest relative error that is expected over near distances, by MSAD or SSSD.</summary>
        public double ErrorNearMax { get; }

        /// <summary>As <see cref="ErrorNearMean"/>, over longer distances up to 100 average edges.</summary>
        public double ErrorMiddleMean { get; }

        /// <summary>As <see cref="ErrorNearMax"/>, over longer distances up to 100 average edges.</summary>
        public double ErrorMiddleMax { get; }

        /// <summary>As <see cref="ErrorNearMean"/>, over distances beyond 100 average edges.</summary>
        public double ErrorFarMean { get; }

        /// <summary>As <see cref="ErrorNearMax"/>, over distances beyond 100 average edges.</summary>
        public double ErrorFarMax { get; }

        /// <summary>The mean relative error of MSAD from several sources.</summary>
        public double ErrorSeveralMean { get; }

        /// <summary>The largest relative error that is expected of MSAD from several sources.</summary>
        public double ErrorSeveralMax { get; }

        /// <summary>Whether the index keeps the mesh, <see cref="BuildOptions.StoreMesh"/>.</summary>
        public bool HasMesh { get; }

        /// <summary>Each property in a line of its own.</summary>
        public override string ToString() =>
            string.Join("\n", Array.ConvertAll(Properties(), property => FormattableString.Invariant(property)));

        private FormattableString[] Properties() => new FormattableString[]
        {
            $"{nameof(Metric)}: {Metric}",
            $"{nameof(MetricFlags)}: {MetricFlags}",
            $"{nameof(MetricFingerprint)}: {MetricFingerprint:x16}",
            $"{nameof(Engine)}: {Engine}",
            $"{nameof(VertexCount)}: {VertexCount}",
            $"{nameof(TriangleCount)}: {TriangleCount}",
            $"{nameof(WeldedVertexCount)}: {WeldedVertexCount}",
            $"{nameof(MeshFingerprint)}: {MeshFingerprint:x16}",
            $"{nameof(TableEntries)}: {TableEntries}",
            $"{nameof(BorderVertexCount)}: {BorderVertexCount}",
            $"{nameof(BoundingBoxDiagonal)}: {BoundingBoxDiagonal}",
            $"{nameof(Delta)}: {Delta}",
            $"{nameof(Seed)}: {Seed}",
            $"{nameof(FormatVersion)}: {FormatVersion}",
            $"{nameof(PatchCounts)}: {PatchCountsText()}",
            $"{nameof(ErrorSources)}: {ErrorSources}",
            $"{nameof(ErrorMean)}: {ErrorMean}",
            $"{nameof(ErrorSignedMean)}: {ErrorSignedMean}",
            $"{nameof(ErrorP99)}: {ErrorP99}",
            $"{nameof(ErrorP999)}: {ErrorP999}",
            $"{nameof(ErrorMax)}: {ErrorMax}",
            $"{nameof(ErrorMeanAtVertices)}: {ErrorMeanAtVertices}",
            $"{nameof(Codec)}: {Codec}",
            $"{nameof(HasPositions)}: {HasPositions}",
            $"{nameof(SmallestStep)}: {SmallestStep}",
            $"{nameof(LargestStep)}: {LargestStep}",
            $"{nameof(AddedVertexCount)}: {AddedVertexCount}",
            $"{nameof(ErrorNearMean)}: {ErrorNearMean}",
            $"{nameof(ErrorNearMax)}: {ErrorNearMax}",
            $"{nameof(ErrorMiddleMean)}: {ErrorMiddleMean}",
            $"{nameof(ErrorMiddleMax)}: {ErrorMiddleMax}",
            $"{nameof(ErrorFarMean)}: {ErrorFarMean}",
            $"{nameof(ErrorFarMax)}: {ErrorFarMax}",
            $"{nameof(ErrorSeveralMean)}: {ErrorSeveralMean}",
            $"{nameof(ErrorSeveralMax)}: {ErrorSeveralMax}",
            $"{nameof(HasMesh)}: {HasMesh}",
        };

        private string PatchCountsText() => string.Join(" / ", PatchCounts);

        private static unsafe int[] Counts(uint* native, int levels)
        {
            var counts = new int[levels];
            for (int level = 0; level < levels; level++) counts[level] = (int)native[level];
            return counts;
        }
    }
}
