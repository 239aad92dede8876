using System;
using System.Threading;
using System.Threading.Tasks;

namespace Geoidx.Tests
{
    /// <summary>An AppDomain or a program that ends while native calls that call back run in it.</summary>
    internal static class Endings
    {
        private const int Side = 150;

        private static readonly TimeSpan Soon = TimeSpan.FromSeconds(8);

        /// <summary>Begins calls with callbacks of some kind and leaves them alone.</summary>
        internal static int Leave(string callbacks)
        {
            Action work = callbacks switch
            {
                "none" => () => GeodesicIndex.Build(Shapes.Plane(Side)),
                "progress" => () => GeodesicIndex.Build(Shapes.Plane(Side), null, new Progress<float>()),
                "token" => () => GeodesicIndex.Build(
                    Shapes.Plane(Side), null, null, new CancellationTokenSource().Token),
                "metric" => () => GeodesicIndex.Build(Shapes.Plane(Side), MetricOptions()),
                "solver" => SolveOnAndOn,
                "visitor" => VerifyOnAndOn,
                "allocator" => () => GeodesicIndex.Build(
                    Shapes.Square(), new BuildOptions { Allocator = new CountingAllocator() }),
                _ => throw new ArgumentException(callbacks),
            };
            Task.Run(work);
            Thread.Sleep(TimeSpan.FromSeconds(1.5));
            return 0;
        }

        /// <summary>Does so in an AppDomain of its own, which it unloads: 0 when that takes a short time.</summary>
        internal static int Unload(string callbacks)
        {
            AppDomain domain = AppDomain.CreateDomain(callbacks);
            domain.ExecuteAssembly(typeof(Endings).Assembly.Location, new[] { "leave", callbacks });
            DateTime before = DateTime.UtcNow;
            AppDomain.Unload(domain);
            TimeSpan taken = DateTime.UtcNow - before;
            Thread.Sleep(TimeSpan.FromSeconds(1)); // in which native threads that were left would crash
            return taken < Soon ? 0 : 1;
        }

        private static BuildOptions MetricOptions() =>
            new BuildOptions { Metric = MetricKind.Callback, MetricCallback = Measure };

        private static void Measure(int source, ReadOnlySpan<int> targets, Span<double> distances)
        {
            int[] vertices = targets.ToArray();
            for (int i = 0; i < vertices.Length; i++) distances[i] = Shapes.PlaneDistance(Side, source, vertices[i]);
        }

        private static void SolveOnAndOn()
        {
            using var solver = new GeodesicSolver(Shapes.Plane(Side), MetricOptions());
            while (true) solver.FromSources(0);
        }

        private static void VerifyOnAndOn()
        {
            while (true) GeodesicIndex.Verify(new byte[1000]);
        }
    }
}
