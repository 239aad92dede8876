using System;
using System.Runtime.InteropServices;

namespace Geoidx
{
#if NET
    internal static class NativeLoader
    {
        internal const string Advice =
            "GeodesicLibrary.Path or the environment variable GEOIDX_LIBRARY may name its file.";

        private static IntPtr library;

        static NativeLoader() =>
            NativeLibrary.SetDllImportResolver(
                typeof(NativeLoader).Assembly,
                (name, _, _) => name == NativeMethods.Library ? library : IntPtr.Zero);

        /// <summary>Binds the imports to this file, or to one that is found.</summary>
        /// <returns>The file, or where it is, for messages.</returns>
        internal static string Load(string? asked)
        {
            string? file = asked ?? LibraryPlaces.Find();
            if (file != null) library = NativeLibrary.Load(file);
            return file ?? LibraryPlaces.OfTheSystem;
        }
    }
#elif UNITY_5_3_OR_NEWER
    internal static class NativeLoader
    {
        internal const string Advice =
            "The package has it for the editor and players on 64-bit Windows and Linux; on other platforms these " +
            "sources compile, but have nothing to call.";

        internal static string Load(string? asked) => "Unity's plugins";
    }
#else
    internal static class NativeLoader
    {
        internal const string Advice =
            "GeodesicLibrary.Path or the environment variable GEOIDX_LIBRARY may name its file.";

        /// <summary>Binds the imports to this file, or to one that is found unless the runtime knows better.</summary>
        /// <returns>The file, or where it is, for messages.</returns>
        internal static string Load(string? asked)
        {
            string? file = asked ?? LibraryPlaces.Find();
            if (file == null) return LibraryPlaces.OfTheSystem;
            if (RuntimeInformation.IsOSPlatform(OSPlatform.Windows)) Preload(file);
            else if (!TryMap(file))
                return asked == null ? LibraryPlaces.OfTheSystem : throw new DllNotFoundException(
                    $"{file}: this runtime cannot be told a path; put the library beside the assembly.");
            return file;
        }

        // Windows binds later imports to a loaded module of the same base name.
        private static void Preload(string file)
        {
            if (LoadLibraryW(file) == IntPtr.Zero) throw new DllNotFoundException(file);
        }

        // Elsewhere a loaded library is known by its soname, which has a version that an import does not name.
        private static bool TryMap(string file)
        {
            try
            {
                mono_dllmap_insert(IntPtr.Zero, NativeMethods.Library, null, file, null);
                return true;
            }
            catch (Exception e) when (e is DllNotFoundException || e is EntryPointNotFoundException)
            {
                return false;
            }
        }

        [DllImport("kernel32", CharSet = CharSet.Unicode)]
        private static extern IntPtr LoadLibraryW(string file);

        [DllImport("__Internal", CharSet = CharSet.Ansi)]
        private static extern void mono_dllmap_insert(
            IntPtr assembly, string library, string? function, string targetLibrary, string? targetFunction);
    }
#endif
}
