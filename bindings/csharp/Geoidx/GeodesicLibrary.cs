using System;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;

namespace Geoidx
{
    /// <summary>The native library behind this assembly, loaded at its first use.</summary>
    public static class GeodesicLibrary
    {
        private const uint Expected = 100; // geoidx_version() of the header these sources are written for
        private const uint ExpectedAbi = 0; // its GEOIDX_ABI_VERSION

        private static readonly object Gate = new object();
        private static volatile bool isLoaded;
        private static string? loadedFile;
        private static uint loadedVersion;
        private static string? path;

        /// <summary>
        /// The file of the native library, to be set before anything else of this assembly is used. When it is null
        /// (the default), the environment variable GEOIDX_LIBRARY gives it; without one, the library is looked for in
        /// runtimes/&lt;rid&gt;/native beside the assembly, beside the assembly, and where the system looks. Unity
        /// finds it among its plugins, whatever this says.
        /// </summary>
        /// <exception cref="InvalidOperationException">
        /// A library is loaded already, which cannot be undone; also when its version has been refused.
        /// </exception>
        public static string? Path
        {
            get => path;
            set
            {
                lock (Gate)
                {
                    if (loadedFile != null)
                        throw new InvalidOperationException($"The native library is loaded already: {loadedFile}.");
                    path = value;
                }
            }
        }

        /// <summary>The release of the native library that these sources are written for.</summary>
        public static Version ExpectedVersion => AsVersion(Expected);

        /// <summary>The release of the native library that is loaded.</summary>
        /// <exception cref="GeodesicLibraryException">It cannot be loaded, or its version does not fit.</exception>
        public static Version Version
        {
            get
            {
                Load();
                return AsVersion(loadedVersion);
            }
        }

        /// <summary>A short English phrase for a status, also for numbers that are unknown here.</summary>
        public static string Describe(GeodesicStatus status)
        {
            Load();
            return StatusText(status);
        }

        // Mono binds the imports of a method when it compiles it: this must have returned before a method is
        // called that contains one.
        internal static void Load()
        {
            if (isLoaded) return;
            lock (Gate)
            {
                if (isLoaded) return;
                loadedFile ??= LoadAndAskVersion(path ?? Environment.GetEnvironmentVariable("GEOIDX_LIBRARY"));
                CheckVersion(loadedVersion, loadedFile);
                CheckAbi(AskAbi(), loadedFile);
                isLoaded = true;
            }
        }

        internal static void CheckVersion(uint version, string file)
        {
            Version loaded = AsVersion(version), expected = ExpectedVersion;
            if (loaded.Major == expected.Major && loaded.Minor >= expected.Minor) return;
            throw new GeodesicLibraryException(
                $"The native library has version {loaded}, this assembly needs version {expected} or a later one " +
                $"of the same major version. It was loaded from {file}.");
        }

        private static void CheckAbi(uint abi, string file)
        {
            if (abi == ExpectedAbi) return;
            throw new GeodesicLibraryException(
                $"The native library has the binary interface {abi}, this assembly needs {ExpectedAbi}. " +
                $"It was loaded from {file}.");
        }

        private static string LoadAndAskVersion(string? asked)
        {
            string? file = string.IsNullOrEmpty(asked) ? null : asked;
            try
            {
                file = NativeLoader.Load(file);
                loadedVersion = AskVersion();
                return file;
            }
            catch (Exception e) when (e is DllNotFoundException || e is EntryPointNotFoundException ||
                                      e is BadImageFormatException)
            {
                throw new GeodesicLibraryException(
                    $"The native library cannot be loaded{(file == null ? "" : $" from {file}")}: " +
                    $"{e.Message.TrimEnd('.')}. {NativeLoader.Advice}", e);
            }
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static uint AskVersion() => NativeMethods.geoidx_version();

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static uint AskAbi() => NativeMethods.geoidx_abi_version();

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static string StatusText(GeodesicStatus status) =>
            NativeText.FromUtf8(NativeMethods.geoidx_status_string(status));

        private static Version AsVersion(uint version) =>
            new Version((int)(version / 10000), (int)(version / 100 % 100), (int)(version % 100));
    }
}
