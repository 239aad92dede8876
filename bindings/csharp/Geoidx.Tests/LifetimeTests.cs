using System;
using System.Buffers;
using System.IO;
using System.Linq;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Threading;
using System.Threading.Tasks;
using Xunit;

namespace Geoidx.Tests
{
    public class LifetimeTests
    {
        [Fact]
        public void DisposeReturnsAllMemory()
        {
            var allocator = new CountingAllocator();
            GeodesicIndex index = GeodesicIndex.Build(Shapes.Plane(9), new BuildOptions { Allocator = allocator });
            GeodesicIndex opened = GeodesicIndex.Open(index.ToBytes(), new OpenOptions { Allocator = allocator });
            GeodesicQuery query = opened.CreateQuery();
            query.Distance(0, 3);
            Assert.True(allocator.Bytes > 0);
            opened.Dispose();
            index.Dispose();
            Assert.True(allocator.Bytes > 0);
            query.Dispose();
            query.Dispose();
            Assert.Equal(0, allocator.Bytes);
        }

        /// <summary>Memory that counts its pins, or that cannot be pinned.</summary>
        private sealed class CountedMemory<T> : MemoryManager<T> where T : unmanaged
        {
            private readonly T[] array;
            private readonly bool canBePinned;
            private GCHandle handle;

            internal CountedMemory(T[] array, bool canBePinned = true)
            {
                this.array = array;
                this.canBePinned = canBePinned;
            }

            internal int Pins { get; private set; }

            public override Span<T> GetSpan() => array;

            public override unsafe MemoryHandle Pin(int elementIndex = 0)
            {
                if (!canBePinned) throw new ObjectDisposedException(nameof(CountedMemory<T>));
                handle = GCHandle.Alloc(array, GCHandleType.Pinned);
                Pins++;
                return new MemoryHandle((void*)handle.AddrOfPinnedObject(), default, this);
            }

            public override void Unpin()
            {
                handle.Free();
                Pins--;
            }

            protected override void Dispose(bool disposing)
            {
            }
        }

        [Fact]
        public void APinThatFailsLeavesNoOtherBehind()
        {
            var positions = new CountedMemory<float>(new float[] { 0, 0, 0, 1, 0, 0, 0, 1, 0 });
            var broken = new CountedMemory<int>(new[] { 0, 1, 2 }, canBePinned: false);
            GeodesicMesh mesh = GeodesicMesh.From<float>(positions.Memory, broken.Memory);
            Assert.Throws<ObjectDisposedException>(() => GeodesicIndex.Build(mesh));
            Assert.Equal(0, positions.Pins);

            var vertices = new CountedMemory<int>(new[] { 0, 1 });
            var costs = new CountedMemory<double>(new double[] { 1 }, canBePinned: false);
            var options = new BuildOptions
            {
                Metric = MetricKind.Edges,
                EdgeCostVertices = vertices.Memory,
                EdgeCosts = costs.Memory,
            };
            Assert.Throws<ObjectDisposedException>(() => GeodesicIndex.Build(Shapes.Square(), options));
            Assert.Equal(0, vertices.Pins);
        }

        [Fact]
        public void TheFinalizerReturnsAllMemory()
        {
            var allocator = new CountingAllocator();
            var thread = new Thread(() => Abandon(allocator));
            thread.Start();
            thread.Join();
            Assert.True(SpinWait.SpinUntil(() => IsFreedByCollection(allocator), TimeSpan.FromSeconds(20)));
        }

        [Fact]
        public void OnlyItsQueriesAnswerAfterAnIndexIsDisposed()
        {
            GeodesicIndex index = GeodesicIndex.Build(Shapes.Square());
            using GeodesicQuery query = index.CreateQuery();
            index.Dispose();
            foreach (Action call in CallsOf(index)) Assert.Throws<ObjectDisposedException>(call);
            Assert.Equal(1, query.Distance(0, 1), 1e-4);
            Assert.Equal(4, index.VertexCount);
        }

        [Fact]
        public void NothingAnswersAfterDispose()
        {
            GeodesicIndex index = GeodesicIndex.Build(Shapes.Square());
            GeodesicQuery query = index.CreateQuery();
            var solver = new GeodesicSolver(Shapes.Square());
            query.Dispose();
            index.Dispose();
            solver.Dispose();
            using var surface = new GeodesicSurface(Shapes.Square());
            var point = new SurfacePoint(0, 1, 0, 0);
            var floats = new float[4];
            var doubles = new double[1];
            Action[] calls =
            {
                () => query.Distance(0, 1),
                () => query.FromSources(new[] { 0 }, floats),
                () => query.FromSourcesWithin(new[] { 0 }, 1, floats),
                () => query.FromEachSource(new[] { 0 }, floats),
                () => query.Matrix(new[] { 0 }, new[] { 0, 1, 2, 3 }, floats),
                () => query.NearestSources(new[] { 0 }, new int[4], floats),
                () => query.Within(new[] { 0 }, 1, new int[4], floats),
                () => query.NearestTargets(0, new[] { 1, 2 }, new int[4], floats),
                () => query.FarthestPoints(new[] { 0 }, new int[4], floats),
                () => query.Prepare(0),
                () => query.FromPrepared(0),
                () => query.SetThreads(1),
                () => query.PrepareTarget(surface, point),
                () => query.TryNextStep(surface, point, out _, out _, out _),
                () => solver.Distance(0, 1),
                () => solver.FromSources(0),
                () => solver.Distances(new[] { 0 }, new[] { 1 }, doubles),
                () => solver.Distances(new[] { 0 }, default, default),
                () => solver.PointDistances(new SurfacePoint[1], new SurfacePoint[1], doubles),
            };
            foreach (Action call in calls.Concat(CallsOf(index))) Assert.Throws<ObjectDisposedException>(call);
        }

        [Fact]
        public async Task EightTasksAskOneIndex()
        {
            const int side = 30;
            using GeodesicIndex index = GeodesicIndex.Build(Shapes.Plane(side));
            var random = new Random(1);
            VertexPair[] pairs = Enumerable.Range(0, 300)
                .Select(_ => new VertexPair(random.Next(side * side), random.Next(side * side)))
                .ToArray();
            float[] expected = index.Distances(pairs);
            float[] field = index.FromSources(7);
            await Task.WhenAll(Enumerable.Range(0, 8).Select(_ => Task.Run(() =>
            {
                using GeodesicQuery query = index.CreateQuery();
                for (int i = 0; i < pairs.Length; i++)
                {
                    Assert.Equal(expected[i], index.Distance(pairs[i].Source, pairs[i].Target));
                    Assert.Equal(expected[i], query.Distance(pairs[i].Source, pairs[i].Target));
                }
                Assert.Equal(field, index.FromSources(7));
            })));
        }

        [Fact]
        public async Task TasksBuildSaveAndOpen()
        {
            string path = Path.GetTempFileName();
            try
            {
                using GeodesicIndex index = await GeodesicIndex.BuildAsync(Shapes.Plane(9));
                await index.SaveAsync(path);
                using GeodesicIndex opened = await GeodesicIndex.OpenAsync(path);
                Assert.Equal(index.Distance(0, 80), opened.Distance(0, 80));
            }
            finally
            {
                File.Delete(path);
            }
        }

        private static Action[] CallsOf(GeodesicIndex index) => new Action[]
        {
            () => index.Distance(0, 1),
            () => index.Distances((0, 1)),
            () => index.Distances(),
            () => index.FromSources(0),
            () => index.FromEachSource(0),
            () => index.Matrix(new[] { 0 }, new[] { 1 }),
            () => index.CreateQuery(),
            () => index.Save("never.geoidx"),
            () => index.Save(new MemoryStream()),
            () => index.ToBytes(),
        };

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static void Abandon(CountingAllocator allocator)
        {
            GeodesicIndex index = GeodesicIndex.Build(Shapes.Plane(9), new BuildOptions { Allocator = allocator });
            index.CreateQuery().Distance(0, 3);
            Assert.True(allocator.Bytes > 0);
        }

        private static bool IsFreedByCollection(CountingAllocator allocator)
        {
            GC.Collect();
            GC.WaitForPendingFinalizers();
            return allocator.Bytes == 0;
        }
    }
}
