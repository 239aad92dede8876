using System;
using Xunit;

namespace Geoidx.Tests
{
    public class SolverTests
    {
        private const double Exact = 1e-12;

        [Fact]
        public void TheSolverIsExact()
        {
            using var cube = new GeodesicSolver(Shapes.Cube());
            Assert.Equal(Math.Sqrt(5), cube.Distance(0, 7), Exact);
            Assert.Equal(8, cube.VertexCount);
            using var cone = new GeodesicSolver(Shapes.Cone(9, 0.3));
            double[] distances = cone.FromSources(1);
            for (int steps = 0; steps <= 4; steps++)
                Assert.Equal(Shapes.RimDistance(0.3, steps), distances[1 + steps], Exact);
        }

        [Fact]
        public void ATolerantSolverIsNearlyExact()
        {
            using var exact = new GeodesicSolver(Shapes.Plane(10));
            using var tolerant = new GeodesicSolver(Shapes.Plane(10), new BuildOptions { SolverTolerance = 1e-5 });
            double expected = exact.Distance(0, 57);
            Assert.InRange(tolerant.Distance(0, 57), expected * (1 - 1e-4), expected * (1 + 1e-4));
        }

        [Fact]
        public void TargetsAreAnsweredInTheirOrder()
        {
            using var plane = new GeodesicSolver(Shapes.Plane(10));
            var distances = new double[3];
            plane.Distances(new[] { 0, 99 }, new[] { 98, 0, 11 }, distances);
            Assert.Equal(1, distances[0], Exact);
            Assert.Equal(0, distances[1], Exact);
            Assert.Equal(Math.Sqrt(2), distances[2], Exact);
            plane.Distances(new[] { 0 }, default, default);
        }

        [Fact]
        public void PointsOfTheSurfaceAreStraightApart()
        {
            using var square = new GeodesicSolver(Shapes.Square());
            var center = new SurfacePoint(0, 0.5, 0, 0.5);
            var corner = new SurfacePoint(1, 0, 0, 1);
            var inside = new SurfacePoint(0, 0.25, 0.5, 0.25);
            var distances = new double[2];
            square.PointDistances(new[] { center }, new[] { corner, inside }, distances);
            Assert.Equal(Math.Sqrt(0.5), distances[0], Exact);
            Assert.Equal(Math.Sqrt(0.125), distances[1], Exact);
            Assert.Equal((0, 0.25, 0.5, 0.25), (inside.Triangle, inside.Weight0, inside.Weight1, inside.Weight2));
        }

        [Fact]
        public void EdgesCostTheirLengthOrWhatIsSaid()
        {
            var options = new BuildOptions { Metric = MetricKind.Edges };
            using (var lengths = new GeodesicSolver(Shapes.Square(), options))
                Assert.Equal(2, lengths.Distance(1, 3), Exact);
            options.EdgeCostVertices = new[] { 1, 0 };
            options.EdgeCosts = new[] { 0.25 };
            using var costs = new GeodesicSolver(Shapes.Square(), options);
            Assert.Equal(1.25, costs.Distance(1, 3), Exact);
        }

        [Fact]
        public void FacesCostWhatIsSaid()
        {
            var options = new BuildOptions
            {
                Metric = MetricKind.Weighted, FaceCosts = new[] { 3.0, 5.0 }, PointsPerEdge = 3,
            };
            using var square = new GeodesicSolver(Shapes.Square(), options);
            Assert.Equal(3, square.Distance(0, 1), Exact);
            Assert.Equal(5, square.Distance(2, 3), Exact);
            Assert.Equal(3 * Math.Sqrt(2), square.Distance(0, 2), Exact);
        }

        [Fact]
        public void LengthsReplacePositions()
        {
            double[] lengths = { 2, 2 * Math.Sqrt(2), 2, 2, 2, 2 * Math.Sqrt(2) };
            using var square = new GeodesicSolver(Shapes.Square(), new BuildOptions { EdgeLengths = lengths });
            Assert.Equal(2 * Math.Sqrt(2), square.Distance(1, 3), Exact);
        }

        [Fact]
        public void NearVerticesAreWelded()
        {
            float[] positions = { 0, 0, 0, 1, 0, 0, 1, 1, 0, 1.001f, 0, 0, 2, 0, 0, 1, 1.001f, 0 };
            var mesh = GeodesicMesh.From(positions, new[] { 0, 1, 2, 3, 4, 5 });
            using (var apart = new GeodesicSolver(mesh)) Assert.Equal(double.PositiveInfinity, apart.Distance(0, 4));
            using var together = new GeodesicSolver(mesh, new BuildOptions { WeldTolerance = 0.01 });
            Assert.Equal(2, together.Distance(0, 4), 0.01);
        }
    }
}
