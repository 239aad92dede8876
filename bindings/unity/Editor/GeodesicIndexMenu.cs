using System;
using System.IO;
using System.Threading;
using UnityEditor;
using UnityEngine;

namespace Geoidx.Editor
{
    /// <summary>Builds the index of a selected mesh, as an asset beside it, behind a progress bar.</summary>
    public static class GeodesicIndexMenu
    {
        private const string Command = "Assets/Build Geodesic Index";

        /// <summary>
        /// Builds the index of a mesh and saves it to a path of the project, which should end in .bytes. The build
        /// stops when the user cancels it. The options' <see cref="BuildOptions.StageProgress"/> is told too.
        /// </summary>
        /// <returns>Whether the index was built; not when the user cancelled.</returns>
        public static bool Build(Mesh mesh, string path, BuildOptions? options = null)
        {
            using var cancellation = new CancellationTokenSource();
            options ??= new BuildOptions();
            IProgress<BuildStage>? listener = options.StageProgress;
            options.StageProgress = new ProgressBar(mesh.name, listener, cancellation);
            try
            {
                using GeodesicIndex index =
                    GeodesicIndex.Build(mesh.ToGeodesicMesh(), options, null, cancellation.Token);
                index.Save(path);
                AssetDatabase.ImportAsset(path);
                return true;
            }
            catch (OperationCanceledException)
            {
                return false;
            }
            finally
            {
                options.StageProgress = listener;
                EditorUtility.ClearProgressBar();
            }
        }

        [MenuItem(Command)]
        private static void BuildSelected()
        {
            Mesh? mesh = SelectedMesh();
            if (mesh != null) Build(mesh, PathBeside(mesh));
        }

        [MenuItem(Command, true)]
        private static bool CanBuildSelected() => SelectedMesh() != null;

        private static Mesh? SelectedMesh()
        {
            if (!(Selection.activeObject is GameObject selected)) return Selection.activeObject as Mesh;
            MeshFilter filter = selected.GetComponentInChildren<MeshFilter>();
            if (filter != null && filter.sharedMesh != null) return filter.sharedMesh;
            SkinnedMeshRenderer skinned = selected.GetComponentInChildren<SkinnedMeshRenderer>();
            return skinned == null ? null : skinned.sharedMesh;
        }

        private static string PathBeside(Mesh mesh)
        {
            string asset = AssetDatabase.GetAssetPath(mesh);
            bool isInProject = asset.StartsWith("Assets/", StringComparison.Ordinal);
            string folder = isInProject ? Path.GetDirectoryName(asset)! : "Assets";
            return AssetDatabase.GenerateUniqueAssetPath($"{folder.Replace('\\', '/')}/{FileName(mesh)}.geoidx.bytes");
        }

        private static string FileName(Mesh mesh) =>
            mesh.name.Length == 0 ? "mesh" : string.Join("_", mesh.name.Split(Path.GetInvalidFileNameChars()));

        private sealed class ProgressBar : IProgress<BuildStage>
        {
            private readonly string mesh;
            private readonly IProgress<BuildStage>? listener;
            private readonly CancellationTokenSource cancellation;

            internal ProgressBar(string mesh, IProgress<BuildStage>? listener, CancellationTokenSource cancellation)
            {
                this.mesh = mesh;
                this.listener = listener;
                this.cancellation = cancellation;
            }

            public void Report(BuildStage stage)
            {
                if (EditorUtility.DisplayCancelableProgressBar($"Geodesic index of {mesh}", stage.Name, stage.Fraction))
                    cancellation.Cancel();
                listener?.Report(stage);
            }
        }
    }
}
