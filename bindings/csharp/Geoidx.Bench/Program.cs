using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.Linq;
using System.Runtime.InteropServices;
using Geoidx;

// What SSSD costs more by way of C# than in C, over the same pairs by the same query: medians of runs of both in turn.
// Exit code 1 when memory is allocated.

using GeodesicIndex index = Bench.Terrain(60);
using GeodesicQuery query = index.CreateQuery();
using var bench = new Bench(query);

var random = new Random(1);
VertexPair[] randomPairs = Enumerable.Range(0, 20_000)
    .Select(_ => new VertexPair(random.Next(index.VertexCount), random.Next(index.VertexCount))).ToArray();
VertexPair[] samePairs = Enumerable.Range(0, 200_000).Select(i => new VertexPair(i % 3600, i % 3600)).ToArray();

Console.WriteLine("pairs                           C ns     C# ns  overhead ns  bytes/call");
double bytes = bench.Compare("a vertex and itself", samePairs);
bytes += bench.Compare("random, 3,600 vertices", randomPairs);
return bytes == 0 ? 0 : 1;

internal sealed unsafe class Bench : IDisposable
{
    private const int Runs = 31;

    private readonly GeodesicQuery query;
    private readonly IntPtr geoidx = NativeLibrary.Load(Path.Combine(AppContext.BaseDirectory, "libgeoidx.so"));
    private readonly IntPtr loop = NativeLibrary.Load(Path.Combine(AppContext.BaseDirectory, "libnative_loop.so"));

    internal Bench(GeodesicQuery query) => this.query = query;

    public void Dispose()
    {
        NativeLibrary.Free(loop);
        NativeLibrary.Free(geoidx);
    }

    internal static GeodesicIndex Terrain(int side)
    {
        var positions = new float[3 * side * side];
        for (int v = 0; v < side * side; v++)
        {
            positions[3 * v] = v % side;
            positions[3 * v + 1] = v / side;
            positions[3 * v + 2] = 2 * MathF.Sin(v % side * 0.3f) * MathF.Cos(v / side * 0.2f);
        }
        int[] triangles = Enumerable.Range(0, (side - 1) * (side - 1))
            .Select(i => i / (side - 1) * side + i % (side - 1))
            .SelectMany(v => new[] { v, v + 1, v + side + 1, v, v + side + 1, v + side }).ToArray();
        return GeodesicIndex.Build<float>(positions, triangles);
    }

    /// <summary>Prints medians; returns the managed bytes that a call allocates.</summary>
    internal double Compare(string name, VertexPair[] pairs)
    {
        var native = new float[pairs.Length];
        var managed = new float[pairs.Length];
        for (int i = 0; i < 5; i++) { InC(pairs, native); InCSharp(pairs, managed); }
        if (!native.AsSpan().SequenceEqual(managed)) throw new InvalidDataException("C and C# differ.");

        var times = new (double C, double CSharp)[Runs];
        long before = GC.GetAllocatedBytesForCurrentThread();
        for (int i = 0; i < Runs; i++) times[i] = (InC(pairs, native), InCSharp(pairs, managed));
        double bytes = (GC.GetAllocatedBytesForCurrentThread() - before) / ((double)Runs * pairs.Length);

        double inC = Median(times.Select(time => time.C));
        double inCSharp = Median(times.Select(time => time.CSharp));
        double overhead = Median(times.Select(time => time.CSharp - time.C));
        Console.WriteLine($"{name,-24} {inC,11:F1} {inCSharp,9:F1} {overhead,12:F1} {bytes,11:F3}");
        return bytes;
    }

    private static double Median(IEnumerable<double> values) =>
        values.OrderBy(value => value).ElementAt(Runs / 2);

    private static double NanosecondsEach(long start, int count) =>
        (Stopwatch.GetTimestamp() - start) * 1e9 / Stopwatch.Frequency / count;

    private double InCSharp(VertexPair[] pairs, float[] distances)
    {
        long start = Stopwatch.GetTimestamp();
        for (int i = 0; i < pairs.Length; i++) distances[i] = query.Distance(pairs[i].Source, pairs[i].Target);
        return NanosecondsEach(start, pairs.Length);
    }

    private double InC(VertexPair[] pairs, float[] distances)
    {
        var run = (delegate* unmanaged<IntPtr, IntPtr, VertexPair*, ulong, float*, int>)
            NativeLibrary.GetExport(loop, "native_loop");
        IntPtr sssd = NativeLibrary.GetExport(geoidx, "geoidx_query_sssd");
        fixed (VertexPair* first = pairs)
        fixed (float* results = distances)
        {
            long start = Stopwatch.GetTimestamp();
            int status = run(sssd, query.NativeHandle, first, (ulong)pairs.Length, results);
            double each = NanosecondsEach(start, pairs.Length);
            return status == 0 ? each : throw new InvalidDataException($"The C loop failed with {status}.");
        }
    }
}
