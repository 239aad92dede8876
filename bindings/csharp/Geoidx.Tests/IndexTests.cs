using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Numerics;
using System.Runtime.InteropServices;
using Xunit;

namespace Geoidx.Tests
{
    public sealed class IndexTests : IDisposable
    {
        private const int Side = 12;
        private const double LeafTolerance = 1e-3; // far more than half a step of the tables of leaves of this size

        private readonly GeodesicIndex plane = GeodesicIndex.Build(Shapes.Plane(Side));

        public void Dispose() => plane.Dispose();

        // Across leaves an index is not exact.
        private static void AssertNearly(double exact, float distance) =>
            Assert.InRange(distance, 0.95 * exact, 1.05 * exact);

        [Fact]
        public void DistancesInAPlaneAreNearlyStraight()
        {
            for (int target = 0; target < Side * Side; target++)
                AssertNearly(Shapes.PlaneDistance(Side, 17, target), plane.Distance(17, target));
        }

        [Fact]
        public void DistancesOnACubeAreThoseOfItsNet()
        {
            using GeodesicIndex cube = GeodesicIndex.Build(Shapes.Cube());
            Assert.Equal(1, cube.Distance(0, 1), LeafTolerance);
            Assert.Equal(Math.Sqrt(2), cube.Distance(0, 3), LeafTolerance);
            Assert.Equal(Math.Sqrt(5), cube.Distance(0, 7), LeafTolerance);
        }

        [Theory]
        [InlineData(GeodesicEngine.Graph)]
        [InlineData(GeodesicEngine.Overlay)]
        public void DistancesOnAConeAreChordsOrPassTheApex(GeodesicEngine engine)
        {
            const double angle = 0.35;
            using GeodesicIndex cone = GeodesicIndex.Build(
                Shapes.Cone(17, angle), new BuildOptions { Engine = engine, Threads = 1 });
            for (int steps = 1; steps <= 8; steps++)
                Assert.Equal(Shapes.RimDistance(angle, steps), cone.Distance(1, 1 + steps), LeafTolerance);
            Assert.Equal(1, cone.Distance(0, 9), LeafTolerance);
        }

        [Fact]
        public void PairsGiveTheSameBitsAsSingleQuestions()
        {
            VertexPair[] pairs = { (0, 5), (5, 0), (143, 7), (9, 9) };
            Assert.Equal(pairs.Select(pair => plane.Distance(pair.Source, pair.Target)), plane.Distances(pairs));
            Assert.Empty(plane.Distances());
        }

        [Fact]
        public void SourcesGiveTheDistanceToTheNearest()
        {
            float[] distances = plane.FromSources(0, Side * Side - 1);
            for (int v = 0; v < distances.Length; v++)
            {
                double expected = Math.Min(
                    Shapes.PlaneDistance(Side, 0, v), Shapes.PlaneDistance(Side, Side * Side - 1, v));
                AssertNearly(expected, distances[v]);
            }
        }

        [Fact]
        public void EachSourceGivesTheSameBitsAsAlone()
        {
            Assert.Equal(plane.FromSources(3).Concat(plane.FromSources(77)), plane.FromEachSource(3, 77));
        }

        [Fact]
        public void AMatrixHasARowForEachSource()
        {
            int[] sources = { 17, 0, 143, 0 }, targets = { 5, 17, 131 };
            float[] matrix = plane.Matrix(sources, targets);
            Assert.Equal(12, matrix.Length);
            for (int i = 0; i < matrix.Length; i++)
                AssertNearly(Shapes.PlaneDistance(Side, sources[i / 3], targets[i % 3]), matrix[i]);
            var written = new float[12];
            plane.Matrix(sources, targets, written);
            Assert.Equal(matrix, written);
        }

        [Fact]
        public void AStructOfFloatsAndASpanAreTheSameMesh()
        {
            (float[] positions, int[] triangles) = Shapes.PlaneArrays(Side);
            var vertices = new Vector3[Side * Side];
            for (int v = 0; v < vertices.Length; v++)
                vertices[v] = new Vector3(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]);

            using GeodesicIndex structs = GeodesicIndex.Build(GeodesicMesh.From(vertices, triangles));
            using GeodesicIndex span = GeodesicIndex.Build<Vector3>(vertices, triangles);
            using GeodesicIndex floats = GeodesicIndex.Build<float>(positions, triangles);
            Assert.Equal(plane.ToBytes(), structs.ToBytes());
            Assert.Equal(plane.ToBytes(), span.ToBytes());
            Assert.Equal(plane.ToBytes(), floats.ToBytes());
        }

        private struct Vector3d
        {
            public Vector3d(double x, double y) => (X, Y, Z) = (x, y, 0);

            public double X, Y, Z;
        }

        private struct LitVertex
        {
            public LitVertex(double x, double y) => (Position, Normal) = (new Vector3d(x, y), new Vector3(1, 2, 3));

            public Vector3d Position;
            public Vector3 Normal;
        }

        private struct WeightedVertex
        {
            public Vector3 Position;
            public double Weight;
        }

        [StructLayout(LayoutKind.Explicit)]
        private struct PlacedVertex
        {
            [FieldOffset(24)] public float Weight;
            [FieldOffset(0)] public Vector3d Position;
        }

        private static void CheckUnitSquare<TVertex>(Func<double, double, TVertex> corner, PositionType? type = null)
            where TVertex : unmanaged
        {
            var corners = new[] { corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1) };
            var triangles = new[] { 0, 1, 2, 0, 2, 3 };
            using GeodesicIndex square = GeodesicIndex.Build(GeodesicMesh.From(corners, triangles, type));
            Assert.Equal(Math.Sqrt(2), square.Distance(1, 3), LeafTolerance);
            if (type != null) return;
            using GeodesicIndex span = GeodesicIndex.Build<TVertex>(corners, triangles);
            Assert.Equal(square.ToBytes(), span.ToBytes());
        }

        [Fact]
        public void AStructOfDoublesIsAMesh()
        {
            CheckUnitSquare((x, y) => (x, y, 0.0));
            CheckUnitSquare((x, y) => (x, y, 0.0), PositionType.Double);
            CheckUnitSquare((x, y) => new Vector3d(x, y));
            CheckUnitSquare((x, y) => new LitVertex(x, y));
            CheckUnitSquare((x, y) => new PlacedVertex { Position = new Vector3d(x, y), Weight = 2 });
        }

        [Fact]
        public void AStructThatBeginsWithFloatsIsAMeshOfFloats()
        {
            CheckUnitSquare((x, y) => new WeightedVertex { Position = new Vector3((float)x, (float)y, 0), Weight = 2 });
            CheckUnitSquare((x, y) => (new Vector3((float)x, (float)y, 0), new Vector3(1, 2, 3)));
        }

        [Fact]
        public void TheInformationPrintsEveryProperty()
        {
            using GeodesicIndex cube = GeodesicIndex.Build(Shapes.Cube());
            string[] lines = cube.Info.ToString().Split('\n');
            Assert.Equal(
                typeof(GeodesicInfo).GetProperties().Select(property => property.Name),
                lines.Select(line => line.Split(':')[0]));
            Assert.Contains("Metric: Exact", lines);
            Assert.Contains("VertexCount: 8", lines);
            Assert.Contains("TriangleCount: 12", lines);
            Assert.Contains($"PatchCounts: {string.Join(" / ", cube.Info.PatchCounts)}", lines);
        }

        [Fact]
        public void SmallValuesPrintWhatTheyHold()
        {
            CultureInfo before = CultureInfo.CurrentCulture;
            var culture = (CultureInfo)CultureInfo.InvariantCulture.Clone();
            culture.NumberFormat.NumberDecimalSeparator = ",";
            CultureInfo.CurrentCulture = culture;
            try
            {
                Assert.Equal("(3, -1)", new VertexPair(3, -1).ToString());
                Assert.Equal("triangle 5 (0.25, 0.5, 0.25)", new SurfacePoint(5, 0.25, 0.5, 0.25).ToString());
                Assert.Equal("13 % tables", new BuildStage(0.125f, "tables").ToString());
                Assert.Equal(
                    "issue 104, Corrupt at byte 12: a problem",
                    new GeodesicIssue(GeodesicIssueNumber.Posi, GeodesicStatus.Corrupt, 12, "a problem").ToString());
            }
            finally
            {
                CultureInfo.CurrentCulture = before;
            }
        }

        [Fact]
        public void TheInformationIsThatOfTheMeshAndTheOptions()
        {
            var options = new BuildOptions
            {
                Engine = GeodesicEngine.Graph, Seed = 7, LevelCount = 2, Patches = new[] { 3, 2 }, Delta = 0.5,
            };
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Plane(Side), options);
            GeodesicInfo info = index.Info;
            Assert.Equal(Side * Side, index.VertexCount);
            Assert.Equal(Side * Side, info.VertexCount);
            Assert.Equal(Side * Side, info.WeldedVertexCount);
            Assert.Equal(2 * (Side - 1) * (Side - 1), info.TriangleCount);
            Assert.Equal((MetricKind.Exact, MetricFlags.Unfoldable), (info.Metric, info.MetricFlags));
            Assert.Equal((GeodesicEngine.Graph, 7ul, 0.5), (info.Engine, info.Seed, info.Delta));
            Assert.Equal((Side - 1) * Math.Sqrt(2), info.BoundingBoxDiagonal, 1e-6);
            Assert.Equal(2, info.PatchCounts.Count);
            Assert.True(info.PatchCounts[0] >= 3 && info.PatchCounts[1] >= 6);
            Assert.True(info.TableEntries > 0 && info.BorderVertexCount > 0 && info.ErrorSources > 0);
            Assert.InRange(info.ErrorMean, 0, info.ErrorMax);
            Assert.InRange(info.ErrorP99, 0, info.ErrorP999);
            Assert.InRange(Math.Abs(info.ErrorSignedMean), 0, info.ErrorMean);
            Assert.Equal(info.ErrorMean, info.ErrorMeanAtVertices);
            Assert.InRange(info.ErrorNearMean, 0, info.ErrorNearMax);
            Assert.InRange(info.ErrorMiddleMean, 0, info.ErrorMiddleMax);
            Assert.Equal((0.0, 0.0), (info.ErrorFarMean, info.ErrorFarMax));
            Assert.Equal(info.ErrorMax, Math.Max(info.ErrorNearMax, info.ErrorMiddleMax));
            Assert.InRange(info.ErrorSeveralMean, 0, info.ErrorSeveralMax);
            Assert.Equal(0ul, info.MetricFingerprint);
            Assert.Equal(plane.Info.MeshFingerprint, info.MeshFingerprint);
            Assert.Equal(plane.Info.FormatVersion, info.FormatVersion);
        }

        [Fact]
        public void WhatIsSavedIsOpened()
        {
            string folder = Path.Combine(Path.GetTempPath(), $"geoidx-{Guid.NewGuid():N}");
            Directory.CreateDirectory(folder);
            try
            {
                string path = Path.Combine(folder, "Fläche-平面.geoidx");
                plane.Save(path);
                using GeodesicIndex opened = GeodesicIndex.Open(path);
                Assert.Equal(plane.FromSources(5), opened.FromSources(5));
                Assert.Equal(plane.ToBytes(), File.ReadAllBytes(path));
            }
            finally
            {
                Directory.Delete(folder, recursive: true);
            }
        }

        [Fact]
        public void StreamsAndBytesAreFiles()
        {
            using var stream = new MemoryStream();
            plane.Save(stream);
            stream.Position = 0;
            using GeodesicIndex fromStream = GeodesicIndex.Open(stream);
            using GeodesicIndex fromBytes = GeodesicIndex.Open(plane.ToBytes());
            Assert.Equal(plane.Distance(0, 100), fromStream.Distance(0, 100));
            Assert.Equal(plane.Distance(0, 100), fromBytes.Distance(0, 100));
        }

        [Fact]
        public void AnEmbeddedResourceIsOpened()
        {
            using Stream resource = typeof(IndexTests).Assembly.GetManifestResourceStream("square.geoidx")!;
            using GeodesicIndex square = GeodesicIndex.Open(resource);
            Assert.Equal(4, square.VertexCount);
            Assert.Equal(Math.Sqrt(2), square.Distance(1, 3), 1e-4);
        }

        [Fact]
        public void TheExpectedMeshIsAccepted()
        {
            using GeodesicIndex opened = GeodesicIndex.Open(
                plane.ToBytes(), new OpenOptions { ExpectedMesh = Shapes.Plane(Side) });
            Assert.Equal(plane.VertexCount, opened.VertexCount);
        }

        [Fact]
        public void AnIndexIsOpenedReadyForPairs()
        {
            using GeodesicIndex opened = GeodesicIndex.Open(plane.ToBytes(), new OpenOptions { Pairs = true, Threads = 2 });
            Assert.Equal(plane.Distance(0, plane.VertexCount - 1), opened.Distance(0, plane.VertexCount - 1));
        }

        [Theory]
        [InlineData(false)]
        [InlineData(true)]
        public void AnIndexIsOpenedWithoutLabels(bool pairs)
        {
            const int side = 40;
            using GeodesicIndex built = GeodesicIndex.Build(Shapes.Plane(side));
            byte[] bytes = built.ToBytes();
            var counting = new CountingAllocator();
            var countingLabels = new CountingAllocator();
            using GeodesicIndex opened = GeodesicIndex.Open(
                bytes, new OpenOptions { Pairs = pairs, Labels = false, Allocator = counting });
            using GeodesicIndex labelled = GeodesicIndex.Open(
                bytes, new OpenOptions { Pairs = pairs, Allocator = countingLabels });
            for (int target = 0; target < side * side; target += 37)
            {
                AssertNearly(Shapes.PlaneDistance(side, 17, target), opened.Distance(17, target));
                Assert.Equal(built.Distance(17, target), labelled.Distance(17, target));
            }
            Assert.InRange(counting.Bytes, 1, countingLabels.Bytes - 1);
            Assert.Equal(built.FromSources(17), opened.FromSources(17));
            Assert.Equal(bytes, opened.ToBytes());
        }

        [Fact]
        public void AnIndexVerifies() => Assert.Empty(GeodesicIndex.Verify(plane.ToBytes()));

        [Fact]
        public void EveryProblemIsVisited()
        {
            byte[] bytes = plane.ToBytes();
            bytes[bytes.Length - 1] ^= 1;
            Array.Resize(ref bytes, bytes.Length + 1);
            IReadOnlyList<GeodesicIssue> issues = GeodesicIndex.Verify(bytes);
            Assert.Contains(issues, issue => issue.Status == GeodesicStatus.Corrupt);
            GeodesicIssue wrong = Assert.Single(issues, issue => issue.Status == GeodesicStatus.Checksum);
            Assert.NotEmpty(wrong.Message);
            Assert.Equal(GeodesicIssueNumber.SectionChecksum, wrong.Number);
            Assert.Equal((long)BitConverter.ToUInt64(bytes, LastRecord(bytes) + 16), wrong.Offset);

            var visited = new List<GeodesicIssue>();
            GeodesicStatus first = GeodesicIndex.Verify(bytes, issue =>
            {
                visited.Add(issue);
                return false;
            });
            Assert.Equal(issues[0].Status, first);
            Assert.Single(visited);
        }

        [Fact]
        public void AProblemHasItsNumberAndItsPlace()
        {
            byte[] bytes = plane.ToBytes();
            bytes[8] = 77;
            GeodesicIssue issue = Assert.Single(GeodesicIndex.Verify(bytes));
            Assert.Equal(
                (GeodesicIssueNumber.Version, GeodesicStatus.UnsupportedVersion, 8L),
                (issue.Number, issue.Status, issue.Offset));
        }

        /// <summary>Where the record of the last section stands: format/SPEC.md, section table.</summary>
        private static int LastRecord(byte[] bytes) => 48 * (int)BitConverter.ToUInt32(bytes, 20);

        [Fact]
        public void FarthestPointsAreAsFarAsAnyVertex()
        {
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Square());
            using GeodesicQuery query = index.CreateQuery();
            var points = new int[5];
            var distances = new float[5];
            Assert.Equal(3, query.FarthestPoints(new[] { 0 }, points, distances));
            Assert.Equal(index.FromSources(0).Max(), distances[0]);
            Assert.Equal(distances[0], index.FromSources(0)[points[0]]);
            Assert.Equal(index.FromSources(0, points[0]).Max(), distances[1]);
            Assert.Equal(new[] { 1, 2, 3 }, points.Take(3).OrderBy(point => point));
            Assert.Equal(1, query.FarthestPoints(new[] { 0 }, points.AsSpan(0, 1)));
        }

        [Fact]
        public void NearestSourcesAreAsNearAsAny()
        {
            int[] sources = { 0, 143, 0, 5, 78 };
            var nearest = new int[Side * Side];
            var distances = new float[Side * Side];
            using GeodesicQuery query = plane.CreateQuery();
            query.NearestSources(sources, nearest, distances);
            Assert.Equal(plane.FromSources(sources), distances);
            for (int v = 0; v < nearest.Length; v++)
            {
                double least = sources.Min(source => Shapes.PlaneDistance(Side, source, v));
                double chosen = Shapes.PlaneDistance(Side, sources[nearest[v]], v);
                Assert.InRange(chosen, least, least * 1.05 / 0.95);
                Assert.NotEqual(2, nearest[v]); // vertex 0 is repeated, and its first position is 0
            }
            var alone = new int[Side * Side];
            query.NearestSources(sources, alone);
            Assert.Equal(nearest, alone);
        }

        [Fact]
        public void VerticesWithinARadiusAreSortedByDistance()
        {
            int[] sources = { 17, 100, 18 };
            float[][] fields = sources.Select(source => FromSourceWithin(source, 2.5f)).ToArray();
            float[] least = Enumerable.Range(0, Side * Side).Select(v => fields.Min(field => field[v])).ToArray();
            IsWithin(new[] { 17 }, 2.5f, fields[0]);
            IsWithin(sources, 2.5f, least);
            IsWithin(new[] { 17 }, 0, FromSourceWithin(17, 0));
            IsWithin(new[] { 17 }, float.PositiveInfinity, plane.FromSources(17));
        }

        private float[] FromSourceWithin(int source, float radius)
        {
            using GeodesicQuery query = plane.CreateQuery();
            var field = new float[Side * Side];
            query.FromSourcesWithin(new[] { source }, radius, field);
            return field;
        }

        private void IsWithin(int[] sources, float radius, float[] field)
        {
            int[] expected = Enumerable.Range(0, Side * Side)
                .Where(v => !float.IsPositiveInfinity(field[v]))
                .OrderBy(v => field[v])
                .ThenBy(v => v)
                .ToArray();
            using GeodesicQuery query = plane.CreateQuery();
            var vertices = new int[Side * Side];
            var distances = new float[Side * Side];
            Assert.Equal(expected.Length, query.Within(sources, radius, vertices, distances));
            Assert.Equal(expected, vertices.Take(expected.Length));
            Assert.Equal(expected.Select(v => field[v]), distances.Take(expected.Length));
        }

        [Fact]
        public void TheNearestVerticesAreWrittenWhenThereIsLittleRoom()
        {
            using GeodesicIndex cube = GeodesicIndex.Build(Shapes.Cube());
            using GeodesicQuery query = cube.CreateQuery();
            int[] vertices = { -7, -7, -7, -7, -7 };
            Assert.Equal(4, query.Within(new[] { 0 }, 1.2f, default));
            Assert.Equal(4, query.Within(new[] { 0 }, 1.2f, vertices.AsSpan(0, 1)));
            Assert.Equal(new[] { 0, -7 }, vertices.Take(2));
            Assert.Equal(4, query.Within(new[] { 0 }, 1.2f, vertices));
            Assert.Equal(new[] { 0, 1, 2, 4 }, vertices.Take(4).OrderBy(v => v));
            Assert.Equal(-7, vertices[4]);
        }

        [Fact]
        public void NearestTargetsAreSortedByDistance()
        {
            int[] targets = { 143, 18, 30, 17, 18 }; // at (11, 11), (6, 1), (6, 2), (5, 1)
            using GeodesicQuery query = plane.CreateQuery();
            var positions = new int[6];
            var distances = new float[6];
            Assert.Equal(5, query.NearestTargets(17, targets, positions, distances));
            Assert.Equal(new[] { 3, 1, 4, 2, 0 }, positions.Take(5));
            for (int i = 0; i < 5; i++)
                AssertNearly(Shapes.PlaneDistance(Side, 17, targets[positions[i]]), distances[i]);
            positions[2] = -7;
            Assert.Equal(2, query.NearestTargets(17, targets, positions.AsSpan(0, 2)));
            Assert.Equal(new[] { 3, 1, -7 }, positions.Take(3));
        }

        [Fact]
        public void NearestOfManyTargetsAreAsNearAsAny()
        {
            const int count = 20;
            int[] targets = Enumerable.Range(0, Side * Side).Reverse().ToArray();
            double[] exact = targets.Select(target => Shapes.PlaneDistance(Side, 65, target)).ToArray();
            double[] least = exact.OrderBy(distance => distance).Take(count).ToArray();
            using GeodesicQuery query = plane.CreateQuery();
            var positions = new int[count];
            var distances = new float[count];
            Assert.Equal(count, query.NearestTargets(65, targets, positions, distances));
            Assert.Equal(count, positions.Distinct().Count());
            Assert.Equal(distances.OrderBy(distance => distance), distances);
            for (int i = 0; i < count; i++)
            {
                AssertNearly(least[i], distances[i]);
                AssertNearly(exact[positions[i]], distances[i]);
            }
        }

        [Fact]
        public void AnUnusedVertexIsUnreachable()
        {
            using GeodesicIndex index = GeodesicIndex.Build(
                GeodesicMesh.From(new float[] { 0, 0, 0, 1, 0, 0, 1, 1, 0, 9, 9, 9 }, new[] { 0, 1, 2 }));
            Assert.True(float.IsPositiveInfinity(index.Distance(0, 3)));
            Assert.True(float.IsPositiveInfinity(index.Matrix(new[] { 0 }, new[] { 3 })[0]));
            using GeodesicQuery query = index.CreateQuery();
            var nearest = new int[4];
            var distances = new float[4];
            query.NearestSources(new[] { 1 }, nearest, distances);
            Assert.Equal(new[] { 0, 0, 0, GeodesicQuery.NoSource }, nearest);
            Assert.True(float.IsPositiveInfinity(distances[3]));
            Assert.Equal(1, query.NearestTargets(0, new[] { 3, 1 }, nearest));
            Assert.Equal(1, nearest[0]);
            Assert.Equal(3, query.Within(new[] { 0 }, float.MaxValue, nearest));
        }
    }
}
