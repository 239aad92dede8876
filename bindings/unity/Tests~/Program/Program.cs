using System;
using System.IO;
using System.Linq;
using System.Reflection;
using Geoidx;
using Geoidx.Editor;
using Geoidx.Samples;
using UnityEditor;
using UnityEngine;

/// <summary>Uses the package as Unity would: the editor builds an index, the sample colours by it.</summary>
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

    private static int Main()
    {
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
        Selection.activeObject = new GameObject { Filter = new MeshFilter { mesh = Strip() } };
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
            gameObject = new GameObject { Filter = filter },
            indexAsset = index == null ? null : new BytesAsset(index),
        };
        Call(typeof(ColourByDistance), sample, "Start");
        Color[] colors = filter.mesh.colors;
        Check(colors[0].Equals(sample.near) && colors[7].Equals(sample.far), "the ends have their colours");
        Check(Math.Abs(colors[6].b - 3 / Math.Sqrt(10)) < 1e-3, "the colour goes by the distance");
        Check(colors[8].Equals(sample.unreachable), "an unused vertex is unreachable");
        Call(typeof(ColourByDistance), sample, "OnDestroy");
    }

    private static object? Call(Type type, object? instance, string method) =>
        type.GetMethod(method, BindingFlags.NonPublic | BindingFlags.Static | BindingFlags.Instance)!
            .Invoke(instance, null);

    private static void Check(bool holds, string what)
    {
        if (!holds) throw new InvalidOperationException($"Not so: {what}.");
    }
}
