using System.Collections.Generic;
using System.Globalization;
using System.Text.RegularExpressions;

namespace Geoidx
{
    /// <summary>
    /// What the native library says about arguments, in the terms of these sources: its numbers of 32 bits have no
    /// sign, its names are those of C, and so is infinity.
    /// </summary>
    internal static class NativeMessage
    {
        private static readonly Regex WholeNumber = new Regex(@"(?<![\w.-])\d{10}(?!\w|\.\d)");
        private static readonly Regex Infinity = new Regex(@"\binf\b");
        private static readonly Regex Constant = new Regex(@"\bGEOIDX_(METRIC|ENGINE|POSITION|CODEC)_(\*|[A-Z]+)");
        private static readonly Regex Name = new Regex(@"\b[a-z]+(_[a-z]+)+\b");
        private static readonly Regex Missing = new Regex(@"\b(\w+) is NULL\b");
        private static readonly Regex FirstLetter = new Regex(@"(?<=^|_)[a-z]");
        private static readonly Regex OptionOfOpening = new Regex(@"\bmax_(memory|vertices)\b");
        private static readonly Regex OptionOfOneWord = new Regex(@"^(delta|engine|metric|rounding|threads)(?= -?\d| is )");

        private static readonly Dictionary<string, string> Enums = new Dictionary<string, string>
        {
            ["METRIC"] = nameof(MetricKind),
            ["ENGINE"] = nameof(GeodesicEngine),
            ["POSITION"] = nameof(PositionType),
            ["CODEC"] = nameof(GeodesicCodec),
        };

        private static readonly Dictionary<string, string> OtherNames = new Dictionary<string, string>
        {
            ["distance_count"] = "distances.Length",
            ["edge_cost_count"] = "EdgeCosts.Length",
            ["edge_length_count"] = "EdgeLengths.Length",
            ["face_cost_count"] = "FaceCosts.Length",
            ["position_type"] = "type",
        };

        internal static string OfArguments(string detail)
        {
            string signed = WholeNumber.Replace(detail, number => Signed(number.Value));
            string finite = Infinity.Replace(signed, "Infinity");
            string missing = Missing.Replace(finite, WithoutNull);
            string named = Name.Replace(missing, name => ManagedName(name.Value));
            return Constant.Replace(named, ManagedConstant);
        }

        /// <summary>Of a call that takes <see cref="BuildOptions"/>.</summary>
        internal static string OfOptions(string detail) =>
            OptionOfOneWord.Replace(OfArguments(detail), name => Capitalised(name.Value));

        /// <summary>Of a file that asks for more than <see cref="OpenOptions"/> allow.</summary>
        internal static string OfLimits(string detail) =>
            OptionOfOpening.Replace(detail, name => Capitalised(name.Value));

        private static string Signed(string number) =>
            uint.TryParse(number, NumberStyles.None, CultureInfo.InvariantCulture, out uint bits)
                ? unchecked((int)bits).ToString(CultureInfo.InvariantCulture)
                : number;

        private static string WithoutNull(Match missing) =>
            missing.Groups[1].Value == "metric_callback" ? "metric_callback is null" : $"{missing.Groups[1]} is empty";

        private static string ManagedName(string name) => OtherNames.GetValueOrDefault(name) ?? Capitalised(name);

        private static string Capitalised(string name) =>
            FirstLetter.Replace(name, letter => letter.Value.ToUpperInvariant()).Replace("_", "");

        private static string ManagedConstant(Match constant)
        {
            string type = Enums[constant.Groups[1].Value], value = constant.Groups[2].Value;
            return value == "*" ? type : $"{type}.{Capitalised(value.ToLowerInvariant())}";
        }
    }
}
