using System;
using System.Runtime.InteropServices;

namespace Geoidx
{
#if NET
    internal static class NativeLoader
    {
        private static IntPtr library;

        static NativeLoader() =>
            NativeLibrary.SetDllImportResolver(
                typeof(NativeLoader).Assembly,
                (name, _, _) => name == NativeMethods.Library ? library : IntPtr.Zero);

        /// <summary>Binds the imports to this file.</summary>
        internal static void Load(string file, bool isRequired) => library = NativeLibrary.Load(file);
    }
#elif UNITY_5_3_OR_NEWER
    internal static class NativeLoader
    {
        internal static void Load(string file, bool isRequired) { }
    }
#else
    internal static class NativeLoader
    {
        /// <summary>Binds the imports to this file; when it is not required, the runtime may know better.</summary>
        internal static void Load(string file, bool isRequired)
        {
            if (RuntimeInformation.IsOSPlatform(OSPlatform.Windows)) Preload(file);
            else Map(file, isRequired);
        }

        // Windows binds later imports to a loaded module of the same base name.
        private static void Preload(string file)
        {
            if (LoadLibraryW(file) == IntPtr.Zero) throw new DllNotFoundException(file);
        }

        // Elsewhere a loaded library is known by its soname, which has a version that an import does not name.
        private static void Map(string file, bool isRequired)
        {
            try
            {
                mono_dllmap_insert(IntPtr.Zero, NativeMethods.Library, null, file, null);
            }
            catch (Exception e) when (e is DllNotFoundException || e is EntryPointNotFoundException)
            {
                if (!isRequired) return;
                throw new DllNotFoundException(
                    $"{file}: this runtime cannot be told a path; put the library beside the assembly.", e);
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
