using System;
using System.Collections.Generic;
using System.Linq;
using Xunit;

namespace Geoidx.Tests
{
    /// <summary>Walks to a prepared target, on shapes whose shortest ways are straight once unfolded.</summary>
    public class StepTests
    {
        private const int Side = 12;

        private readonly struct Step
        {
            internal readonly PathPoint Start;
            internal readonly PathPoint End;
            internal readonly double Distance;

            internal Step(PathPoint start, PathPoint end, double distance)
            {
                Start = start;
                End = end;
                Distance = distance;
            }

            internal double Length => Math.Sqrt(
                Math.Pow(End.X - Start.X, 2) + Math.Pow(End.Y - Start.Y, 2) + Math.Pow(End.Z - Start.Z, 2));
        }

        [Fact]
        public void AWalkOnThePlaneIsNearlyTheStraightLine()
        {
            List<Step> steps = Walk(Shapes.Plane(Side), (0.3, 0.4, 0), (9.3, 7.9, 0), Math.Sqrt(9 * 9 + 7.5 * 7.5));
            Assert.All(steps, step => Assert.Equal(0, step.End.Z, 12));
            foreach (Step step in steps)
            {
                double straight = Math.Sqrt(Math.Pow(9.3 - step.Start.X, 2) + Math.Pow(7.9 - step.Start.Y, 2));
                Assert.InRange(step.Distance, 0.95 * straight, 1.05 * straight);
            }
        }

        // The ways lead over the side x = 0, unfolded with bottom and top: 1/4, 1 and 1/4 in one direction.
        [Theory]
        [InlineData(0.3, 0.6)]
        [InlineData(0.75, 0.25)]
        [InlineData(0.5, 0.5)]
        public void AWalkOnTheCubeLeadsOverASide(double fromY, double toY)
        {
            double straight = Math.Sqrt(1.5 * 1.5 + Math.Pow(toY - fromY, 2));
            List<Step> steps = Walk(Shapes.Cube(), (0.25, fromY, 0), (0.25, toY, 1), straight);
            Assert.Contains(steps, step => Math.Abs(step.Start.X) + Math.Abs(step.End.X) < 1e-12);
        }

        [Fact]
        public void AlongEdgesAWalkLeadsFromCornerToCorner()
        {
            using GeodesicIndex index =
                GeodesicIndex.Build(Shapes.Plane(Side), new BuildOptions { Metric = MetricKind.Edges });
            using var surface = new GeodesicSurface(Shapes.Plane(Side));
            using GeodesicQuery query = index.CreateQuery();
            query.PrepareTarget(surface, surface.ClosestPoint(5, 5, 0));
            List<Step> steps = StepsFrom(query, surface, surface.ClosestPoint(2, 2, 0));
            Assert.Equal(new[] { 3.0, 4.0, 5.0 }, steps.Select(step => step.End.X));
            Assert.Equal(new[] { 3.0, 4.0, 5.0 }, steps.Select(step => step.End.Y));
        }

        [Fact]
        public void AtTheTargetAStepStays()
        {
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Plane(Side));
            using var surface = new GeodesicSurface(Shapes.Plane(Side));
            using GeodesicQuery query = index.CreateQuery();
            SurfacePoint target = surface.ClosestPoint(6.2, 3.1, 0);
            query.PrepareTarget(surface, target);
            Step step = NextStep(query, surface, target);
            Assert.Equal(0, step.Distance);
            Assert.Equal(0, step.Length);
            Assert.Equal(6.2, step.Start.X, 6);
            Assert.Equal(3.1, step.End.Y, 6);
        }

        [Fact]
        public void OtherCallsForgetNoTarget()
        {
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Plane(Side));
            using var surface = new GeodesicSurface(Shapes.Plane(Side));
            using GeodesicQuery query = index.CreateQuery();
            SurfacePoint from = surface.ClosestPoint(0.3, 0.4, 0), to = surface.ClosestPoint(9.3, 7.9, 0);
            query.PrepareTarget(surface, to);
            Step expected = NextStep(query, surface, from);
            query.Prepare(7);
            query.FromSources(new[] { 5 }, new float[Side * Side]);
            query.Distance(surface, to, surface.ClosestPoint(5, 1, 0));
            Assert.True(query.TryFindPath(surface, to, from, out _));
            Step step = NextStep(query, surface, from);
            Assert.Equal(expected.Distance, step.Distance);
            Assert.Equal(expected.End.X, step.End.X);
            Assert.Equal(expected.End.Y, step.End.Y);
        }

        [Fact]
        public void StepsLeadToTheLatestTarget()
        {
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Plane(Side));
            using var surface = new GeodesicSurface(Shapes.Plane(Side));
            using GeodesicQuery query = index.CreateQuery();
            SurfacePoint from = surface.ClosestPoint(5.3, 5.4, 0);
            query.PrepareTarget(surface, surface.ClosestPoint(9.3, 7.9, 0));
            query.PrepareTarget(surface, surface.ClosestPoint(1.3, 2.4, 0));
            Assert.InRange(NextStep(query, surface, from).Distance, 4.75, 5.25);
            Assert.Throws<GeodesicArgumentException>(
                () => query.PrepareTarget(surface, new SurfacePoint(0, -1, 1, 1)));
            string message = Assert.Throws<GeodesicArgumentException>(() => NextStep(query, surface, from)).Message;
            Assert.Contains("no target", message);
        }

        [Fact]
        public void NoWayLeadsToAnotherComponent()
        {
            GeodesicMesh two = Shapes.TwoTriangles();
            using GeodesicIndex index = GeodesicIndex.Build(two);
            using var surface = new GeodesicSurface(two);
            using GeodesicQuery query = index.CreateQuery();
            query.PrepareTarget(surface, new SurfacePoint(1, 1, 0, 0));
            Assert.False(
                query.TryNextStep(surface, new SurfacePoint(0, 1, 0, 0), out _, out _, out double distance));
            Assert.Equal(double.PositiveInfinity, distance);
            Assert.Equal(1, NextStep(query, surface, new SurfacePoint(1, 0, 1, 0)).Distance, 6);
        }

        [Fact]
        public void WhatIsWrongIsRefused()
        {
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Plane(Side));
            using var other = new GeodesicSurface(Shapes.Plane(Side + 1));
            using var surface = new GeodesicSurface(Shapes.Plane(Side));
            using GeodesicQuery query = index.CreateQuery();
            var point = new SurfacePoint(0, 1, 0, 0);
            Assert.Throws<GeodesicMeshMismatchException>(() => query.PrepareTarget(other, point));
            query.PrepareTarget(surface, point);
            Assert.Throws<GeodesicMeshMismatchException>(() => NextStep(query, other, point));
            Assert.Throws<ArgumentNullException>(() => query.PrepareTarget(null!, point));
            Assert.Throws<ArgumentNullException>(() => NextStep(query, null!, point));
            surface.Dispose();
            Assert.Throws<ObjectDisposedException>(() => query.PrepareTarget(surface, point));
            Assert.Throws<ObjectDisposedException>(() => NextStep(query, surface, point));
        }

        private static List<Step> Walk(
            GeodesicMesh mesh, (double X, double Y, double Z) from, (double X, double Y, double Z) to, double straight)
        {
            using GeodesicIndex index = GeodesicIndex.Build(mesh);
            using var surface = new GeodesicSurface(mesh);
            using GeodesicQuery query = index.CreateQuery();
            query.PrepareTarget(surface, surface.ClosestPoint(to.X, to.Y, to.Z));
            List<Step> steps = StepsFrom(query, surface, surface.ClosestPoint(from.X, from.Y, from.Z));
            CheckPlace(from, steps[0].Start);
            CheckPlace(to, steps[steps.Count - 1].End);
            for (int i = 1; i < steps.Count; i++)
            {
                PathPoint end = steps[i - 1].End;
                CheckPlace((end.X, end.Y, end.Z), steps[i].Start);
            }
            Assert.InRange(steps.Sum(step => step.Length), straight - 1e-9, 1.03 * straight);
            Assert.InRange(steps[0].Distance, 0.97 * straight, 1.03 * straight);
            return steps;
        }

        private static List<Step> StepsFrom(GeodesicQuery query, GeodesicSurface surface, SurfacePoint from)
        {
            var steps = new List<Step>();
            for (Step step = NextStep(query, surface, from); step.Length > 0;
                step = NextStep(query, surface, step.End.Point))
            {
                Assert.Equal(step.Start.Point.Triangle, step.End.Point.Triangle);
                steps.Add(step);
                Assert.True(steps.Count < 1000, "the walk does not end");
            }
            return steps;
        }

        private static Step NextStep(GeodesicQuery query, GeodesicSurface surface, SurfacePoint from)
        {
            Assert.True(
                query.TryNextStep(surface, from, out PathPoint start, out PathPoint end, out double distance));
            return new Step(start, end, distance);
        }

        private static void CheckPlace((double X, double Y, double Z) expected, PathPoint point)
        {
            Assert.Equal(expected.X, point.X, 9);
            Assert.Equal(expected.Y, point.Y, 9);
            Assert.Equal(expected.Z, point.Z, 9);
        }
    }
}
