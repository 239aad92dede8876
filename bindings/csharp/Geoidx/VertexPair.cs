using System.Runtime.InteropServices;

namespace Geoidx
{
    /// <summary>Two vertices whose distance is asked for.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public readonly struct VertexPair
    {
        /// <summary>The pair of these vertices.</summary>
        public VertexPair(int source, int target)
        {
            Source = source;
            Target = target;
        }

        /// <summary>A vertex of the caller's mesh.</summary>
        public int Source { get; }

        /// <summary>A vertex of the caller's mesh.</summary>
        public int Target { get; }

        /// <summary>Both vertices.</summary>
        public override string ToString() => $"({Source}, {Target})";

        /// <summary>The pair of these vertices.</summary>
        public static implicit operator VertexPair((int Source, int Target) pair) =>
            new VertexPair(pair.Source, pair.Target);
    }
}
