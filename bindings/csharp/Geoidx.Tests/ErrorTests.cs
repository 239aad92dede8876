using System;
using System.Linq;
using System.Text;
using Xunit;

namespace Geoidx.Tests
{
    public class ErrorTests
    {
        private const int MajorOffset = 8; // of format/SPEC.md
        private const int SectionCountOffset = 20;

        private sealed class NoMemory : IGeodesicAllocator
        {
            public IntPtr Allocate(ulong size, ulong alignment) => IntPtr.Zero;

            public void Release(IntPtr memory, ulong size, ulong alignment) =>
                throw new InvalidOperationException("Nothing was given.");
        }

        private static byte[] SquareBytes()
        {
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Square());
            return index.ToBytes();
        }

        private static void Fails<T>(GeodesicStatus status, string detail, Action call) where T : GeodesicException
        {
            T exception = Assert.Throws<T>(call);
            Assert.Equal(status, exception.Status);
            Assert.Contains(detail, exception.Message);
        }

        [Fact]
        public void AVertexOutOfRangeIsAnArgument()
        {
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Square());
            using GeodesicQuery query = index.CreateQuery();
            using var solver = new GeodesicSolver(Shapes.Square());
            using var surface = new GeodesicSurface(Shapes.Square());
            Action[] calls =
            {
                () => index.Distance(0, 4),
                () => index.Distance(-1, 0),
                () => index.Distances((0, 4)),
                () => index.FromSources(4),
                () => index.FromSources(),
                () => index.FromEachSource(4),
                () => index.Matrix(new[] { 4 }, new[] { 0 }),
                () => index.Matrix(new[] { 0 }, new[] { 4 }),
                () => query.Distance(0, 4),
                () => query.Prepare(4),
                () => query.FromPrepared(0),
                () => query.SetThreads(1025),
                () => query.FromSourcesWithin(new[] { 0 }, -1, new float[4]),
                () => query.Matrix(new[] { 4 }, new[] { 0 }, new float[1]),
                () => query.Matrix(new[] { 0 }, new[] { 4 }, new float[1]),
                () => query.NearestSources(new int[0], new int[4]),
                () => query.NearestSources(new[] { 4 }, new int[4]),
                () => query.Within(new int[0], 1, new int[4]),
                () => query.Within(new[] { 4 }, 1, new int[4]),
                () => query.Within(new[] { 0 }, -1, new int[4]),
                () => query.Within(new[] { 0 }, float.NaN, new int[4]),
                () => query.NearestTargets(4, new[] { 0 }, new int[1]),
                () => query.NearestTargets(0, new[] { 4 }, new int[1]),
                () => query.FarthestPoints(new int[0], new int[2]),
                () => query.FarthestPoints(new[] { 0 }, new int[2], new float[1]),
                () => query.PrepareTarget(surface, new SurfacePoint(2, 1, 0, 0)),
                () => query.TryNextStep(surface, new SurfacePoint(0, 1, 0, 0), out _, out _, out _),
                () => solver.Distance(0, 4),
            };
            foreach (Action call in calls) Fails<GeodesicArgumentException>(GeodesicStatus.InvalidArgument, "", call);
            Fails<GeodesicArgumentException>(
                GeodesicStatus.InvalidArgument, "vertex 77", () => index.Distance(77, 0));
        }

        [Fact]
        public void AnIdIsReportedAsItWasGiven()
        {
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Square());
            using GeodesicQuery query = index.CreateQuery();
            using var solver = new GeodesicSolver(Shapes.Square());
            using var surface = new GeodesicSurface(Shapes.Square());
            var onNoTriangle = new[] { new SurfacePoint(-1, 1, 0, 0) };
            var negativeCorner = GeodesicMesh.From(new float[9], new[] { 0, 1, -1 });
            var edgeCost = new BuildOptions
            {
                Metric = MetricKind.Edges,
                EdgeCostVertices = new[] { 0, -1 },
                EdgeCosts = new[] { 1.0 },
            };
            Action[] vertexCalls =
            {
                () => index.Distance(-1, 0),
                () => index.Distances((0, -1)),
                () => index.FromSources(-1),
                () => index.FromEachSource(0, -1),
                () => index.Matrix(new[] { 0 }, new[] { -1 }),
                () => query.Distance(-1, 0),
                () => query.Prepare(-1),
                () => query.FromSourcesWithin(new[] { -1 }, 1, new float[4]),
                () => query.NearestSources(new[] { -1 }, new int[4]),
                () => query.Within(new[] { -1 }, 1, new int[4]),
                () => query.NearestTargets(-1, new[] { 0 }, new int[1]),
                () => query.FarthestPoints(new[] { -1 }, new int[1]),
                () => solver.Distance(0, -1),
                () => GeodesicIndex.Build(Shapes.Square(), edgeCost),
            };
            foreach (Action call in vertexCalls)
                Fails<GeodesicArgumentException>(GeodesicStatus.InvalidArgument, "vertex -1", call);
            Fails<GeodesicArgumentException>(
                GeodesicStatus.InvalidArgument, "vertex -2147483648", () => index.Distance(int.MinValue, 0));
            Fails<GeodesicArgumentException>(
                GeodesicStatus.InvalidArgument, "vertex 2147483647", () => index.Distance(int.MaxValue, 0));
            Fails<GeodesicArgumentException>(
                GeodesicStatus.InvalidArgument,
                "triangle -1",
                () => solver.PointDistances(onNoTriangle, onNoTriangle, new double[1]));
            Fails<GeodesicArgumentException>(
                GeodesicStatus.InvalidArgument,
                "target is on triangle -1",
                () => query.PrepareTarget(surface, onNoTriangle[0]));
            query.PrepareTarget(surface, new SurfacePoint(0, 1, 0, 0));
            Fails<GeodesicArgumentException>(
                GeodesicStatus.InvalidArgument,
                "from is on triangle -1",
                () => query.TryNextStep(surface, onNoTriangle[0], out _, out _, out _));
            Fails<GeodesicMeshException>(
                GeodesicStatus.BadMesh, "vertex -1", () => GeodesicIndex.Build(negativeCorner));
        }

        public static readonly (string Message, Action Call)[] RefusedArguments =
        {
            ("Delta is NaN,", () => Build(new BuildOptions { Delta = double.NaN })),
            ("Delta is NaN,", () => Build(new BuildOptions { Delta = -double.NaN })),
            ("Delta is Infinity,", () => Build(new BuildOptions { Delta = double.PositiveInfinity })),
            ("Delta is -Infinity,", () => Build(new BuildOptions { Delta = double.NegativeInfinity })),
            ("Delta is 200", () => Build(new BuildOptions { Delta = 200 })),
            ("Delta is 4.2949672e+09", () => Build(new BuildOptions { Delta = 4294967200.0 })),
            ("Rounding is NaN,", () => Build(new BuildOptions { Rounding = double.NaN })),
            ("Rounding is 1.5", () => Build(new BuildOptions { Rounding = 1.5 })),
            ("Rounding is -1", () => Build(new BuildOptions { Rounding = -1 })),
            ("TargetError is NaN,", () => Build(new BuildOptions { TargetError = double.NaN })),
            ("TargetError is 1.5", () => Build(new BuildOptions { TargetError = 1.5 })),
            ("Threads is 2000", () => Build(new BuildOptions { Threads = 2000 })),
            ("LevelCount is 9", () => Build(new BuildOptions { LevelCount = 9 })),
            ("LloydIterations is 1001", () => Build(new BuildOptions { LloydIterations = 1001 })),
            ("WeldTolerance must", () => Build(new BuildOptions { WeldTolerance = -1 })),
            ("Engine 7 is not a GeodesicEngine", () => Build(new BuildOptions { Engine = (GeodesicEngine)7 })),
            ("Metric -1 is not a MetricKind", () => Build(new BuildOptions { Metric = (MetricKind)(-1) })),
            ("MetricFlags is -1", () => Build(new BuildOptions { MetricFlags = (MetricFlags)(-1) })),
            ("Metric is MetricKind.Weighted, but FaceCosts is empty",
                () => Build(new BuildOptions { Metric = MetricKind.Weighted })),
            ("Metric is MetricKind.Callback, but MetricCallback is null",
                () => Build(new BuildOptions { Metric = MetricKind.Callback })),
            ("FaceCosts.Length is 3",
                () => Build(new BuildOptions { Metric = MetricKind.Weighted, FaceCosts = new double[3] })),
            ("EdgeLengths.Length is 3", () => Build(new BuildOptions { EdgeLengths = new double[3] })),
            ("PointsPerEdge is 1001",
                () => Build(new BuildOptions
                {
                    Metric = MetricKind.Weighted, FaceCosts = new[] { 1.0, 1.0 }, PointsPerEdge = 1001,
                })),
            ("the cost -4.2949673e+09",
                () => Build(new BuildOptions { Metric = MetricKind.Weighted, FaceCosts = new[] { -4294967295.0, 1 } })),
            ("Metric -1 is not a MetricKind",
                () => new GeodesicSolver(Shapes.Square(), new BuildOptions { Metric = (MetricKind)(-1) })),
            ("SolverTolerance is 0.1",
                () => new GeodesicSolver(Shapes.Square(), new BuildOptions { SolverTolerance = 0.1 })),
            ("type 7 is not a PositionType",
                () => GeodesicIndex.Build(GeodesicMesh.From(
                    new System.Numerics.Vector3[3], new int[3], (PositionType)7))),
            ("codec is not a GeodesicCodec", () => WithIndex(index => index.ToBytes((GeodesicCodec)7))),
            ("codec is not a GeodesicCodec", () => WithIndex(index => index.Save("never.geoidx", (GeodesicCodec)(-1)))),
            ("threads is 1025", () => WithQuery(query => query.SetThreads(1025))),
            ("distances.Length is 3", () => WithQuery(query => query.FromSources(new[] { 0 }, new float[3]))),
            ("there is no source", () => WithQuery(query => query.FromSources(default, new float[4]))),
            ("there is no source", () => WithQuery(query => query.NearestSources(default, new int[4]))),
            ("there is no source", () => WithQuery(query => query.Within(default, 1, new int[4]))),
            ("distances is empty", () => WithQuery(query => query.FromSources(new[] { 0 }, default))),
            ("distances.Length is 1", () => WithQuery(query => query.FromPrepared(new int[2], new float[1]))),
            ("distances.Length is 3", () => WithQuery(query => query.Matrix(new int[2], new int[2], new float[3]))),
            ("nearest.Length is 3", () => WithQuery(query => query.NearestSources(new int[1], new int[3]))),
            ("distances.Length is 3",
                () => WithQuery(query => query.NearestSources(new int[1], new int[4], new float[3]))),
            ("distances.Length is 1", () => WithQuery(query => query.Within(new int[1], 1, new int[2], new float[1]))),
            ("distances.Length is 1",
                () => WithQuery(query => query.NearestTargets(0, new int[2], new int[2], new float[1]))),
            ("no target has been prepared", () => WithQuery(NextStep)),
            ("distances.Length is 3", () => WithSolver(solver => solver.FromSources(new[] { 0 }, new double[3]))),
            ("there is no source", () => WithSolver(solver => solver.FromSources(default, new double[4]))),
        };

        private static void Build(BuildOptions options) => GeodesicIndex.Build(Shapes.Square(), options).Dispose();

        private static void WithIndex(Action<GeodesicIndex> use)
        {
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Square());
            use(index);
        }

        private static void WithQuery(Action<GeodesicQuery> use) =>
            WithIndex(index =>
            {
                using GeodesicQuery query = index.CreateQuery();
                use(query);
            });

        private static void NextStep(GeodesicQuery query)
        {
            using var surface = new GeodesicSurface(Shapes.Square());
            query.TryNextStep(surface, new SurfacePoint(0, 1, 0, 0), out _, out _, out _);
        }

        private static void WithSolver(Action<GeodesicSolver> use)
        {
            using var solver = new GeodesicSolver(Shapes.Square());
            use(solver);
        }

        [Fact]
        public void AMessageHasTheNamesOfTheseSources()
        {
            foreach ((string message, Action call) in RefusedArguments)
            {
                Fails<GeodesicArgumentException>(GeodesicStatus.InvalidArgument, message, call);
                string whole = Assert.Throws<GeodesicArgumentException>(call).Message;
                Assert.DoesNotContain("_", whole);
                Assert.DoesNotContain("NULL", whole);
            }
        }

        [Fact]
        public void SpansOfTheWrongLengthAreArguments()
        {
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Square());
            using GeodesicQuery query = index.CreateQuery();
            using var solver = new GeodesicSolver(Shapes.Square());
            Action[] calls =
            {
                () => index.Distances(new VertexPair[2], new float[1]),
                () => index.FromSources(new[] { 0 }, new float[3]),
                () => index.FromEachSource(new[] { 0, 1 }, new float[4]),
                () => index.Matrix(new[] { 0, 1 }, new[] { 0, 1, 2 }, new float[5]),
                () => query.FromSources(new[] { 0 }, new float[5]),
                () => query.FromPrepared(new[] { 0, 1 }, new float[1]),
                () => query.Matrix(new[] { 0, 1 }, new[] { 0, 1, 2 }, new float[7]),
                () => query.NearestSources(new[] { 0 }, new int[5]),
                () => query.NearestSources(new[] { 0 }, new int[4], new float[5]),
                () => query.Within(new[] { 0 }, 1, new int[4], new float[5]),
                () => query.Within(new[] { 0 }, 1, default, new float[1]),
                () => query.NearestTargets(0, new[] { 0, 1 }, new int[2], new float[3]),
                () => solver.FromSources(new[] { 0 }, new double[3]),
                () => solver.Distances(new[] { 0 }, new[] { 0, 1 }, new double[1]),
                () => GeodesicIndex.Build(GeodesicMesh.From(new float[4], new int[3])),
                () => GeodesicIndex.Build(GeodesicMesh.From(new float[9], new int[4])),
                () => GeodesicMesh.From(new short[9], new int[3]),
                () => GeodesicIndex.Build(Shapes.Square(), new BuildOptions { Patches = new int[9] }),
                () => GeodesicIndex.Build(Shapes.Square(), new BuildOptions { EdgeCosts = new double[1] }),
                () => GeodesicIndex.Open("a\0b"),
            };
            foreach (Action call in calls) Fails<GeodesicArgumentException>(GeodesicStatus.InvalidArgument, "", call);
        }

        [Fact]
        public void NullIsRefused()
        {
            Assert.Throws<ArgumentNullException>(() => GeodesicIndex.Build(null!));
            Assert.Throws<ArgumentNullException>(() => GeodesicIndex.Open((string)null!));
            Assert.Throws<ArgumentNullException>(() => GeodesicIndex.Open((System.IO.Stream)null!));
            Assert.Throws<ArgumentNullException>(() => new GeodesicSolver(null!));
            Assert.Throws<ArgumentNullException>(() => GeodesicMesh.From<float>(null!, new int[3]));
            Assert.Throws<ArgumentNullException>(() => GeodesicMesh.From(new float[9], null!));
            Assert.Throws<ArgumentNullException>(() => GeodesicIndex.Verify(new byte[1], null!));
        }

        [Fact]
        public void NullIsNoListOfVertices()
        {
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Square());
            using var solver = new GeodesicSolver(Shapes.Square());
            Assert.Throws<ArgumentNullException>(() => index.Distances(null!));
            Assert.Throws<ArgumentNullException>(() => index.FromSources((int[])null!));
            Assert.Throws<ArgumentNullException>(() => index.FromEachSource((int[])null!));
            Assert.Throws<ArgumentNullException>(() => index.Matrix(null!, new[] { 0 }));
            Assert.Throws<ArgumentNullException>(() => index.Matrix(new[] { 0 }, null!));
            Assert.Throws<ArgumentNullException>(() => solver.FromSources((int[])null!));
        }

        [Fact]
        public void NegativeNumbersAreOutOfRange()
        {
            BuildOptions[] refused =
            {
                new BuildOptions { Threads = -1 },
                new BuildOptions { LevelCount = -1 },
                new BuildOptions { LloydIterations = -1 },
                new BuildOptions { PointsPerEdge = -1 },
                new BuildOptions { ExactVertices = -1 },
                new BuildOptions { Patches = new[] { 2, -1 } },
            };
            foreach (BuildOptions options in refused)
                Assert.Throws<ArgumentOutOfRangeException>(() => GeodesicIndex.Build(Shapes.Square(), options));
            OpenOptions[] refusedToOpen =
            {
                new OpenOptions { Threads = -1 },
                new OpenOptions { MaxVertices = -1 },
                new OpenOptions { MaxMemory = long.MinValue },
            };
            byte[] bytes = SquareBytes();
            foreach (OpenOptions options in refusedToOpen)
                Assert.Throws<ArgumentOutOfRangeException>(() => GeodesicIndex.Open(bytes, options));
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Square());
            using GeodesicQuery query = index.CreateQuery();
            Assert.Throws<ArgumentOutOfRangeException>(() => query.SetThreads(-1));
        }

        [Fact]
        public void HalfASurrogatePairIsNoPath()
        {
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Square());
            foreach (string path in new[] { "half\ud83d.geoidx", "half\ude00.geoidx" })
            {
                Assert.Throws<ArgumentException>(() => index.Save(path));
                Assert.Throws<ArgumentException>(() => GeodesicIndex.Open(path));
            }
        }

        [Fact]
        public void AMissingFileIsIO() =>
            Fails<GeodesicIOException>(
                GeodesicStatus.IO, "/no/such/file", () => GeodesicIndex.Open("/no/such/file"));

        [Fact]
        public void OtherDataIsNotAnIndex() =>
            Fails<GeodesicDataException>(
                GeodesicStatus.NotAnIndex, "", () => GeodesicIndex.Open(Encoding.ASCII.GetBytes("something else")));

        [Fact]
        public void AnEndTooEarlyIsTruncated() =>
            Fails<GeodesicDataException>(
                GeodesicStatus.Truncated, "", () => GeodesicIndex.Open(SquareBytes().AsSpan(0, 100)));

        [Fact]
        public void BytesTooManyAreCorrupt() =>
            Fails<GeodesicDataException>(
                GeodesicStatus.Corrupt, "", () => GeodesicIndex.Open(SquareBytes().Append((byte)0).ToArray()));

        [Fact]
        public void AChangedByteIsAChecksum()
        {
            byte[] bytes = SquareBytes();
            bytes[bytes.Length - 1] ^= 1;
            Fails<GeodesicDataException>(GeodesicStatus.Checksum, "", () => GeodesicIndex.Open(bytes));
        }

        [Fact]
        public void ANewerFormatIsAVersion()
        {
            byte[] bytes = SquareBytes();
            bytes[MajorOffset] = 99;
            Fails<GeodesicVersionException>(
                GeodesicStatus.UnsupportedVersion, "99", () => GeodesicIndex.Open(bytes));
        }

        [Fact]
        public void AnotherMeshIsAMismatch()
        {
            byte[] bytes = SquareBytes();
            var options = new OpenOptions { ExpectedMesh = Shapes.Cube() };
            Fails<GeodesicMeshMismatchException>(
                GeodesicStatus.MeshMismatch, "8", () => GeodesicIndex.Open(bytes, options));
        }

        [Fact]
        public void TooManySectionsAreALimit()
        {
            byte[] bytes = SquareBytes();
            for (int i = 0; i < 4; i++) bytes[SectionCountOffset + i] = 0xff;
            Fails<GeodesicLimitException>(GeodesicStatus.Limit, "", () => GeodesicIndex.Open(bytes));
        }

        [Theory]
        [InlineData(GeodesicCodec.Packed)]
        [InlineData(GeodesicCodec.Lossless)]
        [InlineData(GeodesicCodec.Mapped)]
        public void MoreThanTheOptionsAllowIsALimit(GeodesicCodec codec)
        {
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Plane(20));
            byte[] bytes = index.ToBytes(codec);
            void Refused(string detail, OpenOptions options) => Fails<GeodesicLimitException>(
                GeodesicStatus.Limit, detail, () => GeodesicIndex.Open(bytes, options));
            Refused("399 that MaxVertices allows", new OpenOptions { MaxVertices = 399 });
            Refused("MaxMemory allows", new OpenOptions { MaxMemory = 1000 });
            var enough = new OpenOptions { MaxVertices = 400, MaxMemory = 1L << 40 };
            using GeodesicIndex opened = GeodesicIndex.Open(bytes, enough);
            Assert.Equal(index.Distance(0, 399), opened.Distance(0, 399));
        }

        [Fact]
        public void AQueryThatNeedsMoreThanMaxMemoryIsALimit()
        {
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Plane(40));
            byte[] bytes = index.ToBytes();
            var allocator = new CountingAllocator();
            long withFields, withPairs;
            using (GeodesicIndex opened = GeodesicIndex.Open(bytes, new OpenOptions { Allocator = allocator }))
            {
                opened.FromSources(0);
                withFields = allocator.Bytes;
                opened.Distance(0, 1599);
                withPairs = allocator.Bytes;
            }
            var options = new OpenOptions { MaxMemory = (withFields + withPairs) / 2 };
            using GeodesicIndex limited = GeodesicIndex.Open(bytes, options);
            float[] field = limited.FromSources(0);
            Fails<GeodesicLimitException>(GeodesicStatus.Limit, "MaxMemory", () => limited.Distance(0, 1599));
            Assert.Equal(field, limited.FromSources(0));
        }

        [Fact]
        public void NoMemoryIsOutOfMemory()
        {
            var options = new BuildOptions { Allocator = new NoMemory() };
            Fails<GeodesicOutOfMemoryException>(
                GeodesicStatus.OutOfMemory, "", () => GeodesicIndex.Build(Shapes.Square(), options));
        }

        [Fact]
        public void APositionThatIsNoNumberIsABadMesh()
        {
            var mesh = GeodesicMesh.From(new[] { 0, 0, 0, 1, 0, 0, 1, float.NaN, 0 }, new[] { 0, 1, 2 });
            Fails<GeodesicMeshException>(GeodesicStatus.BadMesh, "2", () => GeodesicIndex.Build(mesh));
        }

        [Fact]
        public void AnEdgeOfManyIsABadMeshOnRequest()
        {
            float[] positions = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0 };
            var mesh = GeodesicMesh.From(positions, new[] { 0, 1, 2, 0, 1, 3, 0, 1, 4 });
            GeodesicIndex.Build(mesh).Dispose();
            Fails<GeodesicMeshException>(
                GeodesicStatus.BadMesh,
                "",
                () => GeodesicIndex.Build(mesh, new BuildOptions { RefuseEdgesOfMany = true }));
        }

        [Fact]
        public void AMetricThatGivesNoNumberIsACallback()
        {
            var options = new BuildOptions
            {
                Metric = MetricKind.Callback,
                MetricCallback = (_, _, distances) => distances.Fill(double.NaN),
            };
            Fails<GeodesicMetricException>(
                GeodesicStatus.Callback, "the distance NaN", () => GeodesicIndex.Build(Shapes.Square(), options));
        }

        [Theory]
        [InlineData(GeodesicStatus.InvalidArgument, typeof(GeodesicArgumentException))]
        [InlineData(GeodesicStatus.IO, typeof(GeodesicIOException))]
        [InlineData(GeodesicStatus.NotAnIndex, typeof(GeodesicDataException))]
        [InlineData(GeodesicStatus.Truncated, typeof(GeodesicDataException))]
        [InlineData(GeodesicStatus.Corrupt, typeof(GeodesicDataException))]
        [InlineData(GeodesicStatus.Checksum, typeof(GeodesicDataException))]
        [InlineData(GeodesicStatus.UnsupportedVersion, typeof(GeodesicVersionException))]
        [InlineData(GeodesicStatus.MeshMismatch, typeof(GeodesicMeshMismatchException))]
        [InlineData(GeodesicStatus.Limit, typeof(GeodesicLimitException))]
        [InlineData(GeodesicStatus.OutOfMemory, typeof(GeodesicOutOfMemoryException))]
        [InlineData(GeodesicStatus.Cancelled, typeof(OperationCanceledException))]
        [InlineData(GeodesicStatus.BadMesh, typeof(GeodesicMeshException))]
        [InlineData(GeodesicStatus.Callback, typeof(GeodesicMetricException))]
        [InlineData(GeodesicStatus.Internal, typeof(GeodesicException))]
        [InlineData((GeodesicStatus)(-999), typeof(GeodesicException))]
        public void EveryStatusIsItsException(GeodesicStatus status, Type type)
        {
            Exception exception = GeodesicException.For(status, "the detail");
            Assert.IsType(type, exception);
            Assert.Equal("the detail", exception.Message);
            if (exception is GeodesicException failure) Assert.Equal(status, failure.Status);
        }
    }
}
