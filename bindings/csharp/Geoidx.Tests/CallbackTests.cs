using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using System.Threading.Tasks;
using Xunit;

namespace Geoidx.Tests
{
    public class CallbackTests
    {
        private const int Side = 24;

        private sealed class Listener<T> : IProgress<T>
        {
            private readonly Action<T> listen;

            internal Listener(Action<T> listen) => this.listen = listen;

            public void Report(T value) => listen(value);
        }

        private sealed class Fault : Exception
        {
        }

        private static BuildOptions MetricOptions(GeodesicMetric metric) =>
            new BuildOptions { Metric = MetricKind.Callback, MetricCallback = metric };

        private static void ThreeTimesStraight(int source, ReadOnlySpan<int> targets, Span<double> distances)
        {
            int[] vertices = targets.ToArray(); // Debian's Mono lacks the indexer of a ReadOnlySpan
            for (int i = 0; i < vertices.Length; i++)
                distances[i] = 3 * Shapes.PlaneDistance(Side, source, vertices[i]);
        }

        [Fact]
        public void ProgressRisesFromZeroToOne()
        {
            var fractions = new List<float>();
            var stages = new List<BuildStage>();
            int thread = Environment.CurrentManagedThreadId;
            var options = new BuildOptions { StageProgress = new Listener<BuildStage>(stages.Add) };
            var listener = new Listener<float>(fraction =>
            {
                Assert.Equal(thread, Environment.CurrentManagedThreadId);
                fractions.Add(fraction);
            });
            GeodesicIndex.Build(Shapes.Plane(Side), options, listener).Dispose();
            Assert.Equal(0, fractions[0]);
            Assert.Equal(1, fractions[fractions.Count - 1]);
            Assert.Equal(fractions.OrderBy(fraction => fraction), fractions);
            Assert.Equal(fractions, stages.Select(stage => stage.Fraction));
            Assert.All(stages, stage => Assert.NotEmpty(stage.Name));
        }

        [Fact]
        public void WhatProgressThrowsIsThrownOn()
        {
            var listener = new Listener<float>(_ => throw new Fault());
            Assert.Throws<Fault>(() => GeodesicIndex.Build(Shapes.Plane(Side), null, listener));
        }

        [Fact]
        public void ATokenCancelsABuildThatRuns()
        {
            using var source = new CancellationTokenSource();
            var listener = new Listener<float>(fraction =>
            {
                if (fraction > 0) source.Cancel();
            });
            var canceled = Assert.Throws<OperationCanceledException>(
                () => GeodesicIndex.Build(Shapes.Plane(Side), null, listener, source.Token));
            Assert.Equal(source.Token, canceled.CancellationToken);
        }

        [Fact]
        public void ACancelledTokenBuildsNothing()
        {
            var cancelled = new CancellationToken(canceled: true);
            Assert.Throws<OperationCanceledException>(
                () => GeodesicIndex.Build(Shapes.Plane(Side), null, null, cancelled));
        }

        [Fact]
        public async Task ATaskIsCancelledFromAnotherThread()
        {
            using var source = new CancellationTokenSource();
            using var begun = new ManualResetEventSlim();
            Task<GeodesicIndex> build = GeodesicIndex.BuildAsync(
                Shapes.Plane(200),
                new BuildOptions { Threads = 2 },
                new Listener<float>(_ => begun.Set()),
                source.Token);
            Assert.True(begun.Wait(TimeSpan.FromMinutes(1)));
            source.Cancel();
            await Assert.ThrowsAnyAsync<OperationCanceledException>(() => build);
            Assert.True(build.IsCanceled);
        }

        [Theory]
        [InlineData(MetricFlags.None)]
        [InlineData(MetricFlags.Unfoldable)]
        public void TheCallersMetricIsTheDistance(MetricFlags flags)
        {
            BuildOptions options = MetricOptions(ThreeTimesStraight);
            options.MetricFlags = flags;
            options.ExactVertices = Side * Side;
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Plane(Side), options);
            Assert.Equal((MetricKind.Callback, flags), (index.Info.Metric, index.Info.MetricFlags));
            Assert.Equal(3, index.Distance(0, 1), 0.01);
            Assert.Equal(3 * Math.Sqrt(2), index.Distance(0, Side + 1), 0.01);
        }

        [Fact]
        public void ASolverKeepsTheMetric()
        {
            using var solver = new GeodesicSolver(Shapes.Plane(Side), MetricOptions(ThreeTimesStraight));
            GC.Collect();
            GC.WaitForPendingFinalizers();
            Assert.Equal(15, solver.Distance(0, 5), 1e-12);
        }

        [Fact]
        public void WhatTheMetricThrowsIsThrownOn()
        {
            var mesh = Shapes.Plane(Side);
            BuildOptions options = MetricOptions((_, _, _) => throw new Fault());
            Assert.Throws<Fault>(() => GeodesicIndex.Build(mesh, options));
            using var solver = new GeodesicSolver(mesh, options);
            Assert.Throws<Fault>(() => solver.Distance(0, 1));
        }

        [Fact]
        public void ASolverInUseRefusesASecondCall()
        {
            GeodesicSolver? solver = null;
            BuildOptions options = MetricOptions((_, _, _) => solver!.Distance(0, 1));
            using (solver = new GeodesicSolver(Shapes.Plane(Side), options))
                Assert.Throws<InvalidOperationException>(() => solver.Distance(0, 1));
        }

        [Fact]
        public void WhatAVisitorOfProblemsThrowsIsThrownOn() =>
            Assert.Throws<Fault>(() => GeodesicIndex.Verify(new byte[10], _ => throw new Fault()));
    }
}
