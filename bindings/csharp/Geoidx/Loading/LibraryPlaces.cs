#if !UNITY_5_3_OR_NEWER
using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Runtime.InteropServices;
#if NET
using System.Diagnostics.CodeAnalysis;
#endif

namespace Geoidx
{
    internal static class LibraryPlaces
    {
        /// <summary>Where the library is when no file is found.</summary>
        internal const string OfTheSystem = "the system's search path";

        /// <summary>The first library file there is, or null.</summary>
        internal static string? Find() => Folders().SelectMany(Candidates).FirstOrDefault(File.Exists);

        internal static IEnumerable<string> Candidates(string folder)
        {
            yield return Path.Combine(folder, "runtimes", RuntimeId, "native", FileName);
            yield return Path.Combine(folder, FileName);
        }

        private static IEnumerable<string> Folders()
        {
            if (AssemblyFile.Length > 0) yield return Path.GetDirectoryName(AssemblyFile)!;
            yield return AppContext.BaseDirectory;
        }

#if NET
        [UnconditionalSuppressMessage("SingleFile", "IL3000", Justification = "Empty is foreseen.")]
#endif
        // Empty when the assembly was loaded from memory.
        private static string AssemblyFile => typeof(LibraryPlaces).Assembly.Location;

        private static string RuntimeId =>
            $"{SystemName}-{RuntimeInformation.ProcessArchitecture.ToString().ToLowerInvariant()}";

        private static string SystemName =>
            RuntimeInformation.IsOSPlatform(OSPlatform.Windows) ? "win"
            : RuntimeInformation.IsOSPlatform(OSPlatform.OSX) ? "osx"
            : "linux";

        private static string FileName =>
            RuntimeInformation.IsOSPlatform(OSPlatform.Windows) ? "geoidx.dll"
            : RuntimeInformation.IsOSPlatform(OSPlatform.OSX) ? "libgeoidx.dylib"
            : "libgeoidx.so";
    }
}
#endif
