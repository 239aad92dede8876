using System;
using System.IO;
using System.Reflection;
using Xunit;
#if NET
using System.Runtime.Loader;
#endif

namespace Geoidx.Tests
{
    public class LibraryTests
    {
        [Fact]
        public void TheVersionFits() => Assert.Equal(GeodesicLibrary.ExpectedVersion, GeodesicLibrary.Version);

        [Fact]
        public void ALoadedLibraryStays()
        {
            Assert.NotEmpty(GeodesicLibrary.Describe(GeodesicStatus.Ok));
            Assert.Throws<InvalidOperationException>(() => GeodesicLibrary.Path = "elsewhere");
        }

        [Fact]
        public void EveryStatusHasItsPhrase()
        {
            Assert.Equal("success", GeodesicLibrary.Describe(GeodesicStatus.Ok));
            Assert.Equal("cancelled", GeodesicLibrary.Describe(GeodesicStatus.Cancelled));
            Assert.NotEmpty(GeodesicLibrary.Describe((GeodesicStatus)(-999)));
        }

        [Fact]
        public void AnotherVersionIsRefusedByName()
        {
            var refused = Assert.Throws<GeodesicLibraryException>(() => GeodesicLibrary.CheckVersion(990102, "a file"));
            Assert.Contains("99.1.2", refused.Message);
            Assert.Contains(GeodesicLibrary.ExpectedVersion.ToString(), refused.Message);
            Version expected = GeodesicLibrary.ExpectedVersion;
            uint VersionOf(int minor) => (uint)(expected.Major * 10000 + minor * 100);
            GeodesicLibrary.CheckVersion(VersionOf(expected.Minor + 1), "a file");
            Assert.Throws<GeodesicLibraryException>(
                () => GeodesicLibrary.CheckVersion(VersionOf(expected.Minor - 1), "a file"));
        }

        [Fact]
        public void AnAssemblyFromMemoryFindsTheLibrary()
        {
            Assembly assembly = Assembly.Load(File.ReadAllBytes(typeof(GeodesicIndex).Assembly.Location));
            Assert.Empty(assembly.Location);
            Type library = assembly.GetType("Geoidx.GeodesicLibrary")!;
            Assert.Equal(GeodesicLibrary.Version, library.GetProperty("Version")!.GetValue(null));
        }

#if NET
        private delegate object VerifyFunction(ReadOnlySpan<byte> data);

        /// <summary>The assembly a second time, bound to another native library.</summary>
        private sealed class SecondCopy
        {
            private readonly Assembly assembly;

            internal SecondCopy(string nativeLibrary)
            {
                assembly = new AssemblyLoadContext(null).LoadFromAssemblyPath(typeof(GeodesicIndex).Assembly.Location);
                Path = nativeLibrary;
            }

            internal string Path
            {
                set => Library.GetProperty("Path")!.SetValue(null, value);
            }

            internal Type Index => assembly.GetType("Geoidx.GeodesicIndex")!;

            private Type Library => assembly.GetType("Geoidx.GeodesicLibrary")!;

            internal Exception Failure(string type, string method, params object?[] arguments)
            {
                var types = Array.ConvertAll(arguments, argument => argument?.GetType());
                MethodInfo called = Array.Find(
                    assembly.GetType(type)!.GetMethods(),
                    candidate => candidate.Name == method &&
                                 candidate.GetParameters().Length == types.Length &&
                                 (types.Length == 0 || candidate.GetParameters()[0].ParameterType == types[0]))!;
                return Assert.Throws<TargetInvocationException>(() => called.Invoke(null, arguments)).InnerException!;
            }
        }

        private static string Beside(string name) => Path.Combine(AppContext.BaseDirectory, name);

        [Fact]
        public void ALibraryOfAnotherVersionIsRefused()
        {
            var copy = new SecondCopy(Beside("libgeoidx-other.so"));
            Exception refused = copy.Failure("Geoidx.GeodesicLibrary", "get_Version");
            Assert.Equal(nameof(GeodesicLibraryException), refused.GetType().Name);
            Assert.Contains("99.1.2", refused.Message);
            Assert.Contains(Beside("libgeoidx-other.so"), refused.Message);

            var late = Assert.Throws<TargetInvocationException>(() => copy.Path = Beside("libgeoidx.so"));
            Assert.IsType<InvalidOperationException>(late.InnerException);
            Assert.Contains(Beside("libgeoidx-other.so"), late.InnerException.Message);
        }

        [Fact]
        public void AMissingLibraryIsNamed()
        {
            Exception refused = new SecondCopy("/no/such/library.so").Failure("Geoidx.GeodesicLibrary", "get_Version");
            Assert.Equal(nameof(GeodesicLibraryException), refused.GetType().Name);
            Assert.Contains("/no/such/library.so", refused.Message);
        }

        [Fact]
        public void AMissingLibraryMayBeReplaced()
        {
            var copy = new SecondCopy("/no/such/library.so");
            copy.Failure("Geoidx.GeodesicLibrary", "get_Version");
            copy.Path = Beside("libgeoidx-other.so");
            Assert.Contains("99.1.2", copy.Failure("Geoidx.GeodesicLibrary", "get_Version").Message);
        }

        [Fact]
        public void ACheckThatFailsIsNotACleanIndex()
        {
            var verify = new SecondCopy(Beside("libgeoidx-failing.so")).Index
                .GetMethod("Verify", new[] { typeof(ReadOnlySpan<byte>) })!
                .CreateDelegate<VerifyFunction>();
            Exception? failure = Record.Exception(() => verify(new byte[1]));
            Assert.Equal(nameof(GeodesicOutOfMemoryException), failure?.GetType().Name);
        }

        [Fact]
        public void ADefectOfTheLibraryIsInternal()
        {
            Exception failure =
                new SecondCopy(Beside("libgeoidx-failing.so")).Failure("Geoidx.GeodesicIndex", "Open", "a file", null);
            Assert.Equal(nameof(GeodesicException), failure.GetType().Name);
            Assert.Equal("the detail", failure.Message);
            Assert.Equal("Internal", failure.GetType().GetProperty("Status")!.GetValue(failure)!.ToString());
        }
#endif
    }
}
