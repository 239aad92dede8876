using System;

namespace Geoidx
{
    /// <summary>Where a build is.</summary>
    public readonly struct BuildStage
    {
        internal BuildStage(float fraction, string name)
        {
            Fraction = fraction;
            Name = name;
        }

        /// <summary>How much of the build is done, 0 to 1, never falling.</summary>
        public float Fraction { get; }

        /// <summary>A short English name of what is being done.</summary>
        public string Name { get; }

        /// <summary>Percentage and name.</summary>
        public override string ToString() => FormattableString.Invariant($"{100 * Fraction:0} % {Name}");
    }
}
