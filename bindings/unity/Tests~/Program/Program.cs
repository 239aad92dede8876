using System;
using System.IO;
using System.Linq;
using System.Reflection;
using Geoidx;
using Geoidx.Editor;
using Geoidx.Samples;
using Unity.Collections;
using UnityEditor;
using UnityEngine;

/// <summary>Uses the package as Unity would: the editor builds an index, the samples colour and walk by it.</summary>
internal static class Program
{
    private sealed class BytesAsset : TextAsset
    {
        internal BytesAsset(byte[] content) => bytes = content;
    }

    private sealed class Listener : IProgress<BuildStage>
    {
        internal float Latest { get; private set; }

        public void Report(BuildStage stage) => Latest = stage.Fraction;
    }

    private static int Main(string[] arguments)
    {
        if (arguments.Length == 1 && arguments[0] == "without-library") return WithoutTheLibrary();
        string folder = Path.Combine(Path.GetTempPath(), $"geoidx-unity-{Guid.NewGuid():N}");
        Directory.CreateDirectory(Path.Combine(folder, "Assets", "Models"));
        Directory.SetCurrentDirectory(folder);
        try
        {
            byte[] index = TheEditorBuildsAnIndex();
            AnAssetHasAFileName();
            TheCallersOptionsStay();
            AUserCancels();
            TheSampleColours(index);
            TheSampleColours(null);
            TheSampleWalks(index);
            TheSampleWalks(null);
            TheSampleWaitsForATarget();
            TheSampleStaysWhereNoWayLeads();
            AnUnreadableMeshIsRefused();
            NothingIsRefusedByName();
            TheMenuTakesASkinnedMesh();
            NativeArraysGiveTheSameBits();
            NativeArraysTakeWhatIsNearest();
            ThePageMeasures(index);
            ThePageMeasuresInAJob(index);
            APageThatNeverStartedIsDestroyed();
            Console.WriteLine("The Unity package works.");
            return 0;
        }
        finally
        {
            Directory.Delete(folder, recursive: true);
        }
    }

    // Vertex 2 y + x at (x, y), and one that no triangle uses.
    private static Mesh Strip(string name = "strip")
    {
        return new Mesh
        {
            name = name,
            vertices = Enumerable.Range(0, 8).Select(v => new Vector3(v % 2, v / 2, 0))
                .Append(new Vector3(5, 5, 5)).ToArray(),
            triangles = Enumerable.Range(0, 3).Select(y => 2 * y)
                .SelectMany(v => new[] { v, v + 1, v + 3, v, v + 3, v + 2 }).ToArray(),
        };
    }

    private static byte[] TheEditorBuildsAnIndex()
    {
        Selection.activeObject = ObjectWith(new MeshFilter { mesh = Strip() });
        Check((bool)Call(typeof(GeodesicIndexMenu), null, "CanBuildSelected")!, "the menu is enabled");
        Call(typeof(GeodesicIndexMenu), null, "BuildSelected");
        string asset = AssetDatabase.Imported.Single();
        Check(asset == "Assets/Models/strip.geoidx.bytes", "the asset lies beside the mesh");
        Check(EditorUtility.Shown.First().Progress == 0 && EditorUtility.Shown.Last().Progress == 1, "a bar fills");
        Check(EditorUtility.Shown.All(bar => bar.Title.Contains("strip") && bar.Info.Length > 0), "a bar has texts");
        Check(EditorUtility.IsCleared, "the bar is gone");
        return File.ReadAllBytes(asset);
    }

    private static void AnAssetHasAFileName()
    {
        foreach ((string name, string file) in new[] { ("../a/b", ".._a_b"), ("", "mesh") })
        {
            Selection.activeObject = Strip(name);
            Call(typeof(GeodesicIndexMenu), null, "BuildSelected");
            Check(AssetDatabase.Imported.Last() == $"Assets/Models/{file}.geoidx.bytes", $"\"{name}\" is {file}");
        }
    }

    private static void TheCallersOptionsStay()
    {
        var listener = new Listener();
        var options = new BuildOptions { StageProgress = listener };
        Check(GeodesicIndexMenu.Build(Strip(), "options.bytes", options), "the caller's options build");
        Check(options.StageProgress == listener && listener.Latest == 1, "the caller's listener stays and hears");
        GeodesicIndex.Build(Strip().ToGeodesicMesh(), options).Dispose();
    }

    private static void AUserCancels()
    {
        EditorUtility.UserCancels = true;
        Check(!GeodesicIndexMenu.Build(Strip(), "never.bytes"), "the build is cancelled");
        Check(!File.Exists("never.bytes") && EditorUtility.IsCleared, "nothing is left of it");
        EditorUtility.UserCancels = false;
    }

    private static void TheSampleColours(byte[]? index)
    {
        var filter = new MeshFilter { mesh = Strip() };
        var sample = new ColourByDistance
        {
            gameObject = ObjectWith(filter),
            indexAsset = index == null ? null : new BytesAsset(index),
        };
        Call(typeof(ColourByDistance), sample, "Start");
        Color[] colors = filter.mesh.colors;
        Check(colors[0].Equals(sample.near) && colors[7].Equals(sample.far), "the ends have their colours");
        Check(Math.Abs(colors[6].b - 3 / Math.Sqrt(10)) < 1e-3, "the colour goes by the distance");
        Check(colors[8].Equals(sample.unreachable), "an unused vertex is unreachable");
        Call(typeof(ColourByDistance), sample, "OnDestroy");
    }

    // A corner of the strip lies at (10, 0, 0) of the world, the opposite one at (12, 6, 0).
    private static void TheSampleWalks(byte[]? index)
    {
        WalkAlongSurface sample = WalkerOn(Strip());
        sample.indexAsset = index == null ? null : new BytesAsset(index);
        sample.target = new GameObject().transform;
        sample.target.position = new Vector3(12, 6, 0);
        Call(typeof(WalkAlongSurface), sample, "Start");
        int frames = 0;
        for (Vector3 from = sample.transform.position; Apart(from, sample.target.position) > 1e-6; frames++)
        {
            Call(typeof(WalkAlongSurface), sample, "Update");
            Vector3 to = sample.transform.position;
            double left = Apart(to, sample.target.position), way = Apart(from, to);
            Check(way <= 0.2 + 1e-5 && (way > 0.19 || left < 1e-6), "the walk goes on at its speed");
            Check(left < Apart(from, sample.target.position), "the walk leads nearer");
            from = to;
        }
        Check(Math.Abs(frames - Math.Sqrt(10) / 0.1) < 1.5, "the walk is about as long as the straight line");
        Call(typeof(WalkAlongSurface), sample, "Update");
        Check(Apart(sample.transform.position, sample.target.position) < 1e-6, "the walk ends at the target");
        Call(typeof(WalkAlongSurface), sample, "OnDestroy");
    }

    private static void TheSampleWaitsForATarget()
    {
        WalkAlongSurface sample = WalkerOn(Strip());
        Call(typeof(WalkAlongSurface), sample, "Update");
        Call(typeof(WalkAlongSurface), sample, "Start");
        Call(typeof(WalkAlongSurface), sample, "Update");
        Check(sample.transform.position.Equals(new Vector3(10, 0, 0)), "without a target the walk does not begin");
        sample.WalkTo(new Vector3(10, 6, 1));
        Call(typeof(WalkAlongSurface), sample, "Update");
        Check(Apart(sample.transform.position, new Vector3(10, 0.2f, 0)) < 1e-6, "it leads along a side");
        Call(typeof(WalkAlongSurface), sample, "OnDestroy");
        Call(typeof(WalkAlongSurface), new WalkAlongSurface(), "OnDestroy");
    }

    private static void TheSampleStaysWhereNoWayLeads()
    {
        Mesh mesh = Strip();
        mesh.triangles = mesh.triangles.Take(6).Concat(mesh.triangles.Skip(12)).ToArray();
        WalkAlongSurface sample = WalkerOn(mesh);
        Call(typeof(WalkAlongSurface), sample, "Start");
        sample.WalkTo(new Vector3(12, 6, 0));
        Call(typeof(WalkAlongSurface), sample, "Update");
        Check(sample.transform.position.Equals(new Vector3(10, 0, 0)), "no way leads to another component");
        Call(typeof(WalkAlongSurface), sample, "OnDestroy");
    }

    // A frame is a tenth of a second, and the mesh twice as large in the world.
    private static WalkAlongSurface WalkerOn(Mesh mesh)
    {
        Time.deltaTime = 0.1f;
        var filter = new MeshFilter { mesh = mesh, gameObject = ObjectWith() };
        filter.transform.position = new Vector3(10, 0, 0);
        filter.transform.localScale = new Vector3(2, 2, 2);
        var sample = new WalkAlongSurface { ground = filter, gameObject = ObjectWith() };
        sample.transform.position = new Vector3(10, 0, 0);
        return sample;
    }

    private static double Apart(Vector3 a, Vector3 b) =>
        Math.Sqrt(Math.Pow(a.x - b.x, 2) + Math.Pow(a.y - b.y, 2) + Math.Pow(a.z - b.z, 2));

    private static GameObject ObjectWith(params Component[] components) =>
        new GameObject { Components = components };

    private static int WithoutTheLibrary()
    {
        string message = Failure<GeodesicLibraryException>(() => Strip().ToGeodesicMesh().Build());
        Check(message.Contains("Unity's plugins"), "the message says where it looked");
        Check(message.Contains("64-bit Windows and Linux"), "the message says where there is one");
        Console.WriteLine(message);
        return 0;
    }

    private static GeodesicIndex Build(this GeodesicMesh mesh) => GeodesicIndex.Build(mesh);

    private static void AnUnreadableMeshIsRefused()
    {
        Mesh mesh = Strip();
        mesh.isReadable = false;
        string message = Failure<InvalidOperationException>(() => mesh.ToGeodesicMesh());
        Check(message.Contains("strip") && message.Contains("Read/Write"), "the message names mesh and remedy");
    }

    private static void NothingIsRefusedByName()
    {
        Check(Failure<ArgumentNullException>(() => ((Mesh)null!).ToGeodesicMesh()).Contains("mesh"), "no mesh");
        Check(Failure<ArgumentNullException>(() => ((TextAsset)null!).OpenGeodesicIndex()).Contains("asset"), "none");
    }

    private static void TheMenuTakesASkinnedMesh()
    {
        Mesh mesh = Strip("skinned");
        var skinned = new SkinnedMeshRenderer { sharedMesh = mesh };
        Component[][] bodies = { new Component[] { skinned }, new Component[] { new MeshFilter(), skinned } };
        foreach (Component[] components in bodies)
        {
            Selection.activeObject = ObjectWith(components);
            Check((bool)Call(typeof(GeodesicIndexMenu), null, "CanBuildSelected")!, "the menu is enabled");
            Call(typeof(GeodesicIndexMenu), null, "BuildSelected");
            string asset = AssetDatabase.Imported.Last();
            Check(asset == "Assets/Models/skinned.geoidx.bytes", "the asset has the name of the skinned mesh");
            var options = new OpenOptions { ExpectedMesh = mesh.ToGeodesicMesh() };
            new BytesAsset(File.ReadAllBytes(asset)).OpenGeodesicIndex(options).Dispose();
        }
        Selection.activeObject = ObjectWith();
        Check(!(bool)Call(typeof(GeodesicIndexMenu), null, "CanBuildSelected")!, "without a mesh it is disabled");
    }

    private static void NativeArraysGiveTheSameBits()
    {
        using GeodesicIndex index = Strip().ToGeodesicMesh().Build();
        using GeodesicQuery query = index.CreateQuery();
        using var sources = new NativeArray<int>(new[] { 0, 7 }, Allocator.TempJob);
        using var pairs = new NativeArray<VertexPair>(new VertexPair[] { (0, 7), (3, 8) }, Allocator.TempJob);
        float[] nearest = index.FromSources(0, 7), each = index.FromEachSource(0, 7);
        Check(Written(2, distances => index.Distances(pairs, distances)), index.Distances((0, 7), (3, 8)));
        Check(Written(9, distances => index.FromSources(sources, distances)), nearest);
        Check(Written(18, distances => index.FromEachSource(sources, distances)), each);
        Check(Written(9, distances => query.FromSources(sources, distances)), nearest);
        Check(Written(18, distances => query.FromEachSource(sources, distances)), each);
        float[] matrix = index.Matrix(new[] { 0, 7 }, new[] { 0, 7 });
        Check(Written(4, distances => index.Matrix(sources, sources, distances)), matrix);
        Check(Written(4, distances => query.Matrix(sources, sources, distances)), matrix);
        Check(
            Written(9, distances => query.FromSourcesWithin(sources, 1.1f, distances)),
            nearest.Select(distance => distance <= 1.1f ? distance : float.PositiveInfinity).ToArray());
        query.Prepare(2);
        Check(
            Written(2, distances => query.FromPrepared(sources, distances)),
            new[] { index.Distance(2, 0), index.Distance(2, 7) });
    }

    private static void NativeArraysTakeWhatIsNearest()
    {
        using GeodesicIndex index = Strip().ToGeodesicMesh().Build();
        using GeodesicQuery query = index.CreateQuery();
        using var sources = new NativeArray<int>(new[] { 0, 7 }, Allocator.TempJob);
        using var found = new NativeArray<int>(9, Allocator.TempJob);
        float[] distances = Written(9, written => query.NearestSources(sources, found, written));
        Check(distances, index.FromSources(0, 7));
        int[] nearest = { 0, 0, 0, 0, 1, 1, 1, 1, GeodesicQuery.NoSource };
        Check(found.ToArray().SequenceEqual(nearest), "each vertex has its nearest source");
        Written(9, written => Check(query.Within(sources, 1.1f, found, written) == 6, "six are within the radius"));
        Check(found.ToArray().Take(2).SequenceEqual(new[] { 0, 7 }), "sources are nearest to themselves");
        Written(9, written => Check(query.NearestTargets(6, sources, found, written) == 2, "both are reached"));
        Check(found.ToArray().Take(2).SequenceEqual(new[] { 1, 0 }), "the nearer target comes first");
        Check(query.Within(sources, 1.1f, found) == 6, "distances can be left out");
        Check(query.NearestTargets(6, sources, found) == 2, "distances can be left out");
        query.NearestSources(sources, found);
        Check(found.ToArray().SequenceEqual(nearest), "distances can be left out");
        using var only = new NativeArray<int>(new[] { 0 }, Allocator.TempJob);
        using var farthest = new NativeArray<int>(2, Allocator.TempJob);
        Check(query.FarthestPoints(only, farthest) == 2, "two points are found");
        var points = new int[2];
        query.FarthestPoints(new[] { 0 }, points);
        Check(farthest.ToArray().SequenceEqual(points), "they are those of the method that takes spans");
    }

    private static float[] Written(int length, Action<NativeArray<float>> query)
    {
        using var distances = new NativeArray<float>(length, Allocator.TempJob);
        query(distances);
        return distances.ToArray();
    }

    private static void ThePageMeasures(byte[] index)
    {
        var page = new Nearness { indexAsset = new BytesAsset(index) };
        Call(typeof(Nearness), page, "Start");
        Check(Math.Abs(page.Between(0, 6) - 3) < 1e-3, "the page's lines measure along a side");
        Call(typeof(Nearness), page, "OnDestroy");
    }

    private static void ThePageMeasuresInAJob(byte[] index)
    {
        var page = new NearnessInAJob { indexAsset = new BytesAsset(index) };
        Call(typeof(NearnessInAJob), page, "Start");
        page.MeasureFrom(6);
        Check(Math.Abs(page.To(0) - 3) < 1e-3, "the page's job measures along a side");
        page.MeasureFrom(0);
        Check(page.To(0) == 0 && float.IsInfinity(page.To(8)), "the page's job measures again");
        Call(typeof(NearnessInAJob), page, "OnDestroy");
    }

    // Unity destroys what has been active, also when Start failed.
    private static void APageThatNeverStartedIsDestroyed()
    {
        Call(typeof(Nearness), new Nearness(), "OnDestroy");
        Call(typeof(NearnessInAJob), new NearnessInAJob(), "OnDestroy");
    }

    private static string Failure<T>(Action call) where T : Exception
    {
        try
        {
            call();
        }
        catch (T exception)
        {
            return exception.Message;
        }
        throw new InvalidOperationException($"No {typeof(T).Name} was thrown.");
    }

    private static void Check(float[] distances, float[] expected) =>
        Check(distances.SequenceEqual(expected), $"{string.Join(", ", distances)} is {string.Join(", ", expected)}");

    private static object? Call(Type type, object? instance, string method) =>
        type.GetMethod(method, BindingFlags.NonPublic | BindingFlags.Static | BindingFlags.Instance)!
            .Invoke(instance, null);

    private static void Check(bool holds, string what)
    {
        if (!holds) throw new InvalidOperationException($"Not so: {what}.");
    }
}
