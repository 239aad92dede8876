using System;
using System.Linq;
using Xunit;

namespace Geoidx.Tests
{
    public sealed class QueryTests : IDisposable
    {
        private const int Side = 30;

        private readonly GeodesicIndex index = GeodesicIndex.Build(Shapes.Plane(Side));
        private readonly GeodesicQuery query;

        public QueryTests() => query = index.CreateQuery();

        public void Dispose()
        {
            query.Dispose();
            index.Dispose();
        }

        [Fact]
        public void AQueryAnswersAsItsIndexDoes()
        {
            int[] sources = { 4, 500, 888 };
            var distances = new float[query.VertexCount];
            query.FromSources(sources, distances);
            Assert.Equal(index.FromSources(sources), distances);
            Assert.Equal(index.Distance(4, 800), query.Distance(4, 800));
            var fields = new float[3 * query.VertexCount];
            query.FromEachSource(sources, fields);
            Assert.Equal(index.FromEachSource(sources), fields);
            int[] targets = { 0, 899 };
            var matrix = new float[6];
            query.Matrix(sources, targets, matrix);
            Assert.Equal(index.Matrix(sources, targets), matrix);
        }

        [Theory]
        [InlineData(0)]
        [InlineData(5.5f)]
        [InlineData(float.PositiveInfinity)]
        public void BeyondTheRadiusIsInfinite(float radius)
        {
            var distances = new float[query.VertexCount];
            query.FromSourcesWithin(new[] { 435 }, radius, distances);
            float[] expected = index.FromSources(435);
            Assert.Equal(expected.Select(d => d <= radius ? d : float.PositiveInfinity), distances);
        }

        [Fact]
        public void APreparedSourceAnswersNearlyTheSame()
        {
            int[] targets = Enumerable.Range(0, query.VertexCount).ToArray();
            var distances = new float[targets.Length];
            query.Prepare(31);
            query.FromPrepared(targets, distances);
            for (int v = 0; v < targets.Length; v++)
            {
                double exact = Shapes.PlaneDistance(Side, 31, v);
                Assert.InRange(distances[v], 0.98 * exact, 1.02 * exact);
            }
            Assert.Equal(distances[99], query.FromPrepared(99));
        }

        [Fact]
        public void ThreadsGiveTheSameBits()
        {
            var distances = new float[query.VertexCount];
            query.SetThreads(2);
            query.FromSources(new[] { 12 }, distances);
            Assert.Equal(index.FromSources(12), distances);
            int[] sources = { 12, 700, 435 };
            var nearest = new int[query.VertexCount];
            query.NearestSources(sources, nearest, distances);
            using GeodesicQuery alone = index.CreateQuery();
            var nearestByOne = new int[query.VertexCount];
            alone.NearestSources(sources, nearestByOne);
            Assert.Equal(nearestByOne, nearest);
            Assert.Equal(index.FromSources(sources), distances);
        }

        [Fact]
        public void DistancesAcrossPatchesAreNearlyStraight()
        {
            for (int v = 0; v < query.VertexCount; v += 7)
            {
                double exact = Shapes.PlaneDistance(Side, 3, v);
                Assert.InRange(query.Distance(3, v), 0.95 * exact, 1.05 * exact);
            }
        }

        [Fact]
        public void AQueryOutlivesItsIndex()
        {
            float expected = index.Distance(1, 2);
            index.Dispose();
            Assert.Equal(expected, query.Distance(1, 2));
        }

#if NET
        [Fact]
        public void NoQuestionAllocates()
        {
            var distances = new float[query.VertexCount];
            VertexPair[] pairs = { (0, 100), (7, 600) };
            int[] sources = { 0, 77 };
            var found = new int[query.VertexCount];
            using var surface = new GeodesicSurface(Shapes.Plane(Side));
            SurfacePoint from = surface.ClosestPoint(3.3, 4.4, 0), to = surface.ClosestPoint(20.7, 25.2, 0);
            var points = new PathPoint[4 * Side];
            void Ask()
            {
                query.Distance(3, 500);
                index.Distance(3, 500);
                query.FromSources(sources, distances);
                query.FromSourcesWithin(sources, 5, distances);
                query.Matrix(sources, sources, distances.AsSpan(0, 4));
                query.NearestSources(sources, found, distances);
                query.Within(sources, 5, found, distances);
                query.NearestTargets(3, sources, found, distances);
                query.Prepare(3);
                query.FromPrepared(500);
                query.Distance(surface, from, to);
                query.TryFindPath(surface, from, to, out _);
                query.PathPoints(points);
                query.PrepareTarget(surface, to);
                query.TryNextStep(surface, from, out _, out _, out _);
                index.Distances(pairs, distances.AsSpan(0, 2));
                index.FromSources(sources, distances);
                index.Matrix(sources, sources, distances.AsSpan(0, 4));
            }
            Ask();
            long before = GC.GetAllocatedBytesForCurrentThread();
            for (int i = 0; i < 100; i++) Ask();
            Assert.Equal(0, GC.GetAllocatedBytesForCurrentThread() - before);
        }
#endif
    }
}
