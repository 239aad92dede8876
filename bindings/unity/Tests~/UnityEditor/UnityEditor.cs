#nullable disable
using System;
using System.Collections.Generic;

// As much of UnityEditor as the package uses, with the same names and signatures, and what a test asks afterwards.

namespace UnityEditor
{
    [AttributeUsage(AttributeTargets.Method)]
    public sealed class MenuItem : Attribute
    {
        public MenuItem(string itemName, bool isValidateFunction = false)
        {
        }
    }

    public static class Selection
    {
        public static UnityEngine.Object activeObject { get; set; }
    }

    public static class AssetDatabase
    {
        public static List<string> Imported { get; } = new List<string>();

        public static void ImportAsset(string path) => Imported.Add(path);

        public static string GetAssetPath(UnityEngine.Object assetObject) => "Assets/Models/model.fbx";

        public static string GenerateUniqueAssetPath(string path) => path;
    }

    public static class EditorUtility
    {
        public static List<(string Title, string Info, float Progress)> Shown { get; } =
            new List<(string Title, string Info, float Progress)>();

        public static bool IsCleared { get; private set; }

        public static bool UserCancels { get; set; }

        public static bool DisplayCancelableProgressBar(string title, string info, float progress)
        {
            IsCleared = false;
            Shown.Add((title, info, progress));
            return UserCancels && progress > 0;
        }

        public static void ClearProgressBar() => IsCleared = true;
    }
}
