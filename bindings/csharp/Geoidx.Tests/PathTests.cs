using System;
using Xunit;

namespace Geoidx.Tests
{
    /// <summary>Points of the surface and paths, on planes.</summary>
    public class PathTests
    {
        private const int Side = 12;

        [Fact]
        public void TheClosestPointIsStraightBelow()
        {
            using var surface = new GeodesicSurface(Shapes.Plane(Side));
            SurfacePoint point = surface.ClosestPoint(2.25, 3.5, 7, out double distance);
            Assert.Equal(7, distance, 12);
            Assert.Equal(1, point.Weight0 + point.Weight1 + point.Weight2, 12);
            Assert.Throws<GeodesicArgumentException>(() => surface.ClosestPoint(double.NaN, 0, 0));
        }

        [Theory]
        [InlineData(PathQuality.Straight)]
        [InlineData(PathQuality.Exact)]
        public void APathOnThePlaneIsTheStraightLine(PathQuality quality)
        {
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Plane(Side));
            using var surface = new GeodesicSurface(Shapes.Plane(Side));
            using GeodesicQuery query = index.CreateQuery();
            SurfacePoint from = surface.ClosestPoint(0.3, 0.4, 0), to = surface.ClosestPoint(9.3, 7.9, 0);
            double straight = Math.Sqrt(9 * 9 + 7.5 * 7.5);
            Assert.True(query.TryFindPath(surface, from, to, out double length, quality));
            Assert.Equal(straight, length, 9);
            Assert.InRange(query.Distance(surface, from, to), straight * 0.98, straight * 1.02);
            var points = new PathPoint[query.PathPointCount];
            Assert.Equal(points.Length, query.PathPoints(points));
            double sum = 0;
            for (int i = 1; i < points.Length; i++)
                sum += Math.Sqrt(
                    Math.Pow(points[i].X - points[i - 1].X, 2) + Math.Pow(points[i].Y - points[i - 1].Y, 2) +
                    Math.Pow(points[i].Z - points[i - 1].Z, 2));
            Assert.Equal(length, sum, 9);
            Assert.Equal(0.3, points[0].X, 9);
            Assert.Equal(7.9, points[points.Length - 1].Y, 9);
            Assert.Throws<GeodesicArgumentException>(() => query.PathPoints(new PathPoint[1]));
            Assert.Throws<GeodesicArgumentException>(() => query.PathPoints(Array.Empty<PathPoint>()));
            Assert.Throws<GeodesicArgumentException>(() => query.PathPoints(default));
        }

        [Fact]
        public void APathByCostsIsTheStraightLineTimesTheCost()
        {
            GeodesicMesh plane = Shapes.Plane(Side);
            var costs = new double[2 * (Side - 1) * (Side - 1)];
            Array.Fill(costs, 2.5);
            var options = new BuildOptions { Metric = MetricKind.Weighted, FaceCosts = costs };
            using GeodesicIndex index = GeodesicIndex.Build(plane, options);
            using var surface = new GeodesicSurface(plane, options);
            using GeodesicQuery query = index.CreateQuery();
            SurfacePoint from = surface.ClosestPoint(0.3, 0.4, 0), to = surface.ClosestPoint(9.3, 7.9, 0);
            Assert.True(query.TryFindPath(surface, from, to, out double length));
            Assert.Equal(2.5 * Math.Sqrt(9 * 9 + 7.5 * 7.5), length, 5);
            using var without = new GeodesicSurface(plane);
            Assert.Throws<GeodesicArgumentException>(() => query.TryFindPath(without, from, to, out _));
        }

        [Fact]
        public void FieldsBeginAtPointsWithOffsets()
        {
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Plane(Side));
            using var surface = new GeodesicSurface(Shapes.Plane(Side));
            using GeodesicQuery query = index.CreateQuery();
            var sources = new[] { surface.ClosestPoint(5, 5, 0) };
            float[] fromVertex = index.FromSources(5 * Side + 5), field = new float[Side * Side];
            query.FromPoints(surface, sources, new[] { 3f }, field);
            for (int v = 0; v < field.Length; v++) Assert.InRange(field[v] - fromVertex[v], 2.9, 3.1);
            Assert.Throws<GeodesicArgumentException>(() => query.FromPoints(surface, sources, new float[2], field));
        }

        [Fact]
        public void PointsAskForWhatIsNear()
        {
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Plane(Side));
            using var surface = new GeodesicSurface(Shapes.Plane(Side));
            using GeodesicQuery query = index.CreateQuery();
            SurfacePoint[] sources = { surface.ClosestPoint(1.2, 1.3, 0), surface.ClosestPoint(8.6, 8.7, 0) };
            var nearest = new int[Side * Side];
            var distances = new float[Side * Side];
            query.NearestSources(surface, sources, default, nearest, distances);
            Assert.Equal(0, nearest[0]);
            Assert.Equal(1, nearest[Side * Side - 1]);
            query.NearestSources(surface, sources, new[] { 100f, 0f }, nearest);
            Assert.All(nearest, source => Assert.Equal(1, source));
            Assert.Throws<GeodesicArgumentException>(
                () => query.NearestSources(surface, sources, new float[1], nearest));

            var vertices = new int[4];
            var near = new float[4];
            Assert.Equal(4, query.Within(surface, new[] { sources[0] }, default, 1.1f, vertices, near));
            Assert.Equal(Side + 1, vertices[0]);
            Assert.InRange(near[0], 0.359f, 0.362f); // sqrt(0.2^2 + 0.3^2)
            Assert.Equal(0, query.Within(surface, sources, new[] { 2f, 2f }, 1.1f, vertices));

            SurfacePoint[] targets = { sources[1], surface.ClosestPoint(1.7, 1.6, 0), sources[0] };
            var positions = new int[2];
            Assert.Equal(2, query.NearestTargets(surface, sources[0], targets, positions, near.AsSpan(0, 2)));
            Assert.Equal(new[] { 2, 1 }, positions);
            Assert.Equal(0, near[0]);
            Assert.InRange(near[1], 0.58f, 0.59f);
        }

        [Fact]
        public void AnIndexKeepsItsMesh()
        {
            GeodesicMesh mesh = Shapes.Plane(Side);
            using GeodesicIndex plain = GeodesicIndex.Build(mesh);
            Assert.False(plain.Info.HasMesh);
            Assert.Throws<GeodesicArgumentException>(() => new GeodesicSurface(plain));
            using GeodesicIndex built = GeodesicIndex.Build(mesh, new BuildOptions { StoreMesh = true });
            Assert.Equal(plain.ToBytes(), built.ToBytes(mesh: false));
            using var own = new GeodesicSurface(mesh);
            GeodesicSurface kept;
            using (GeodesicIndex opened = GeodesicIndex.Open(built.ToBytes(GeodesicCodec.Mapped)))
            {
                Assert.True(opened.Info.HasMesh);
                kept = new GeodesicSurface(opened);
            }
            using (kept)
            using (GeodesicQuery query = built.CreateQuery())
            {
                SurfacePoint from = kept.VertexPoint(0), to = kept.ClosestPoint(9.3, 7.9, 1);
                Assert.Equal(own.ClosestPoint(9.3, 7.9, 1), to);
                Assert.Equal(own.VertexPoint(0), from);
                Assert.True(query.TryFindPath(kept, from, to, out double length));
                Assert.True(query.TryFindPath(own, from, to, out double same));
                Assert.Equal(same, length);
                Assert.Equal(Math.Sqrt(9.3 * 9.3 + 7.9 * 7.9), length, 9);
            }
            Assert.Throws<ArgumentNullException>(() => new GeodesicSurface((GeodesicIndex)null!));
            Assert.Throws<GeodesicArgumentException>(() => own.VertexPoint(Side * Side));
            Assert.Throws<GeodesicArgumentException>(() => own.VertexPoint(-1));
        }

        [Fact]
        public void WhatIsWrongIsRefused()
        {
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Plane(Side));
            using var other = new GeodesicSurface(Shapes.Plane(Side + 1));
            using var surface = new GeodesicSurface(Shapes.Plane(Side));
            using GeodesicQuery query = index.CreateQuery();
            var point = new SurfacePoint(0, 1, 0, 0);
            Assert.Throws<GeodesicMeshMismatchException>(() => query.Distance(other, point, point));
            Assert.Throws<GeodesicArgumentException>(
                () => query.TryFindPath(surface, point, new SurfacePoint(-1, 1, 0, 0), out _));
            Assert.Throws<ArgumentNullException>(() => query.Distance(null!, point, point));
            Assert.Equal(0, query.PathPointCount);
            surface.Dispose();
            Assert.Throws<ObjectDisposedException>(() => query.Distance(surface, point, point));
        }

        [Fact]
        public void BetweenComponentsThereIsNoPath()
        {
            GeodesicMesh two = Shapes.TwoTriangles();
            using GeodesicIndex index = GeodesicIndex.Build(two);
            using var surface = new GeodesicSurface(two);
            using GeodesicQuery query = index.CreateQuery();
            SurfacePoint a = new SurfacePoint(0, 1, 0, 0), b = new SurfacePoint(1, 1, 0, 0);
            Assert.False(query.TryFindPath(surface, a, b, out _));
            Assert.True(float.IsPositiveInfinity(query.Distance(surface, a, b)));
        }
    }
}
