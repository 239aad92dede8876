using System;
using System.Diagnostics;
using System.Threading;

namespace Geoidx.Tests
{
    /// <summary>
    /// An AppDomain or a program that ends while native calls that call back run in it. What fails is printed, since an
    /// exit code tells neither what an event handler sees nor what a native thread does after Main. The calls run on a
    /// thread of their own, which is waited for once they have returned. Mono 6.8 aborts the threads that are in an
    /// AppDomain that it unloads; where that meets a pool thread on its way back to the pool, the runtime can fail an
    /// assertion of its own (exception.c, ThreadAbortException), or wait for ever, which it does without geoidx, too.
    /// </summary>
    internal static class Endings
    {
        private const int Side = 150;

        private static readonly TimeSpan Soon = TimeSpan.FromSeconds(8);

        /// <summary>Begins calls with callbacks of some kind and leaves them to the end that follows.</summary>
        internal static int Leave(string callbacks)
        {
            var thread = new Thread(() => RunUntilTheEnd(Work(callbacks))) { IsBackground = true };
            AwaitCalls(thread, callbacks);
            AppDomain.CurrentDomain.DomainUnload += (_, _) => CheckEnded(thread);
            AppDomain.CurrentDomain.ProcessExit += (_, _) => CheckEnded(thread);
            return 0;
        }

        /// <summary>Does so in an AppDomain of its own, which it unloads within a short time.</summary>
        internal static int Unload(string callbacks)
        {
            AppDomain domain = AppDomain.CreateDomain(callbacks);
            domain.ExecuteAssembly(typeof(Endings).Assembly.Location, new[] { "leave", callbacks });
            Stopwatch taken = Stopwatch.StartNew();
            AppDomain.Unload(domain);
            Expect(taken.Elapsed < Soon, "unloading takes long");
            Thread.Sleep(TimeSpan.FromSeconds(1)); // in which native threads that were left would crash
            return 0;
        }

        private static Action Work(string callbacks) => callbacks switch
        {
            "none" => () => GeodesicIndex.Build(Shapes.Plane(Side)),
            "progress" => () => GeodesicIndex.Build(Shapes.Plane(Side), null, new Unheard()),
            "token" => () => GeodesicIndex.Build(
                Shapes.Plane(Side), null, null, new CancellationTokenSource().Token),
            "metric" => () => GeodesicIndex.Build(Shapes.Plane(Side), MetricOptions()),
            "solver" => SolveOnAndOn,
            "visitor" => VerifyOnAndOn,
            "allocator" => () => GeodesicIndex.Build(
                Shapes.Square(), new BuildOptions { Allocator = new CountingAllocator() }),
            _ => throw new ArgumentException(callbacks),
        };

        private static void RunUntilTheEnd(Action work)
        {
            try
            {
                work();
            }
            catch (OperationCanceledException)
            {
                Expect(CallsInFlight.IsEnding, "a call is cancelled before the end");
            }
        }

        // Calls that use an allocator must have returned before the end; the others must not.
        private static void AwaitCalls(Thread thread, string callbacks)
        {
            thread.Start();
            if (callbacks == "allocator")
            {
                thread.Join();
                return;
            }
            while (CallsInFlight.Count == 0 && thread.IsAlive) Thread.Yield();
            Thread.Sleep(TimeSpan.FromSeconds(0.5)); // in which calls come to call back
            Expect(thread.IsAlive, "the calls return before the end");
        }

        // Runs after the library's own handler, which was there before.
        private static void CheckEnded(Thread thread)
        {
            Expect(CallsInFlight.Count == 0, "a native call runs on into the end");
            Expect(thread.Join(Soon), "calls go on in the end");
        }

        private static void Expect(bool condition, string otherwise)
        {
            if (!condition) Console.WriteLine("FAILED: " + otherwise);
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

        // Progress<T> would call the pool.
        private sealed class Unheard : IProgress<float>
        {
            public void Report(float value)
            {
            }
        }
    }
}
