using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Runtime.InteropServices;
using Xunit;

namespace Geoidx.Tests
{
    /// <summary>These sources against geoidx.h, as a C compiler sees it.</summary>
    public class HeaderTests
    {
        private const BindingFlags Members =
            BindingFlags.Instance | BindingFlags.Static | BindingFlags.Public | BindingFlags.NonPublic;

        private static readonly (string Prefix, Type Type)[] Enums =
        {
            ("GEOIDX_ERROR_", typeof(GeodesicStatus)),
            ("GEOIDX_POSITION_", typeof(PositionType)),
            ("GEOIDX_METRIC_UNFOLDABLE", typeof(MetricFlags)),
            ("GEOIDX_METRIC_", typeof(MetricKind)),
            ("GEOIDX_ENGINE_", typeof(GeodesicEngine)),
            ("GEOIDX_OPEN_", typeof(OpenFlags)),
            ("GEOIDX_CODEC_", typeof(GeodesicCodec)),
            ("GEOIDX_SAVE_", typeof(SaveFlags)),
            ("GEOIDX_PATH_", typeof(PathQuality)),
            ("GEOIDX_ISSUE_", typeof(GeodesicIssueNumber)),
            ("GEOIDX_", typeof(GeodesicStatus)),
        };

        [Fact]
        public void EveryStructHasItsSize()
        {
            Assert.NotEmpty(Facts("struct"));
            foreach (string[] fact in Facts("struct"))
                Assert.Equal($"{fact[0]} {fact[1]}", $"{fact[0]} {Marshal.SizeOf(Mirror(fact[0]))}");
        }

        [Fact]
        public void EveryFieldHasItsOffsetAndSize()
        {
            Assert.NotEmpty(Facts("field"));
            foreach (string[] fact in Facts("field"))
            {
                FieldInfo? field = Mirror(fact[0]).GetField(fact[1], Members);
                Assert.True(field != null, $"{fact[0]} lacks {fact[1]}");
                Assert.Equal(
                    string.Join(" ", fact),
                    $"{fact[0]} {fact[1]} {Marshal.OffsetOf(Mirror(fact[0]), fact[1])} {SizeOf(field!.FieldType)}");
            }
        }

        [Fact]
        public void NoStructHasMoreFields()
        {
            foreach (IGrouping<string, string[]> fields in Facts("field").GroupBy(fact => fact[0]))
                Assert.Equal(
                    fields.Select(fact => fact[1]),
                    Mirror(fields.Key).GetFields(Members)
                        .OrderBy(field => field.MetadataToken)
                        .Select(field => field.Name));
        }

        [Fact]
        public void EveryConstantHasItsValue()
        {
            Assert.NotEmpty(Facts("constant"));
            foreach (string[] fact in Facts("constant"))
                Assert.Equal($"{fact[0]} {fact[1]}", $"{fact[0]} {ConstantValue(fact[0])}");
        }

        [Fact]
        public void EveryFunctionIsImportedAndNoOther()
        {
            var imported = typeof(NativeMethods).GetMethods(Members | BindingFlags.DeclaredOnly)
                .Select(method => method.Name)
                .Where(name => name.StartsWith("geoidx_", StringComparison.Ordinal));
            Assert.Equal(
                Facts("function").Select(fact => fact[0]).OrderBy(name => name, StringComparer.Ordinal),
                imported.OrderBy(name => name, StringComparer.Ordinal));
        }

        [Fact]
        public void TheVersionIsTheOneExpected()
        {
            int version = int.Parse(Facts("version").Single()[0]);
            Assert.Equal(
                new Version(version / 10000, version / 100 % 100, version % 100), GeodesicLibrary.ExpectedVersion);
        }

        private static IEnumerable<string[]> Facts(string kind)
        {
            using var reader = new StreamReader(typeof(HeaderTests).Assembly.GetManifestResourceStream("header.txt")!);
            return reader.ReadToEnd().Split('\n')
                .Select(line => line.Split(' '))
                .Where(words => words[0] == kind)
                .Select(words => words.Skip(1).ToArray());
        }

        private static string PascalCase(string name) =>
            string.Concat(name.Split('_').Select(word => char.ToUpperInvariant(word[0]) + word.Substring(1)));

        private static Type Mirror(string structName)
        {
            string name = PascalCase(structName.Substring("geoidx_".Length));
            Assembly assembly = typeof(GeodesicIndex).Assembly;
            return assembly.GetType($"Geoidx.Native{name}") ?? assembly.GetType($"Geoidx.{name}", throwOnError: true)!;
        }

        private static int SizeOf(Type type) => type.IsPointer ? IntPtr.Size : Marshal.SizeOf(type);

        private static int ConstantValue(string constant)
        {
            if (constant == "GEOIDX_MAX_LEVELS") return BuildOptions.MaxLevels;
            if (constant == "GEOIDX_NO_SOURCE") return GeodesicQuery.NoSource;
            (string prefix, Type type) = Enums.First(
                candidate => constant.StartsWith(candidate.Prefix, StringComparison.Ordinal));
            string name = constant.Substring(prefix == constant ? "GEOIDX_METRIC_".Length : prefix.Length);
            return (int)Enum.Parse(type, name.Replace("_", ""), ignoreCase: true);
        }
    }
}
