using System;
using System.Runtime.InteropServices;

namespace Geoidx
{
    /// <summary>
    /// A point of the surface: of a triangle that is not degenerate, with the weights of its three corners: not
    /// negative, 1 in sum (to 1e-6; they are scaled to it). A weight of 0 puts it on an edge, one of 1 at a corner.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public readonly struct SurfacePoint
    {
        private readonly uint triangle;
        private readonly uint reserved;
        private readonly Weights weights;

        /// <summary>The point of a triangle of the caller's mesh with these weights of its corners.</summary>
        public SurfacePoint(int triangle, double weight0, double weight1, double weight2)
        {
            this.triangle = (uint)triangle;
            reserved = 0;
            weights = new Weights(weight0, weight1, weight2);
        }

        /// <summary>
        /// A triangle of the caller's mesh: the position of its first corner in the array, divided by three.
        /// </summary>
        public int Triangle => (int)triangle;

        /// <summary>The weight of the triangle's first corner, 0 to 1.</summary>
        public double Weight0 => weights.First;

        /// <summary>The weight of the triangle's second corner, 0 to 1.</summary>
        public double Weight1 => weights.Second;

        /// <summary>The weight of the triangle's third corner, 0 to 1.</summary>
        public double Weight2 => weights.Third;

        /// <summary>Triangle and weights.</summary>
        public override string ToString() =>
            FormattableString.Invariant($"triangle {Triangle} ({Weight0}, {Weight1}, {Weight2})");

        [StructLayout(LayoutKind.Sequential)]
        private readonly struct Weights
        {
            internal readonly double First;
            internal readonly double Second;
            internal readonly double Third;

            internal Weights(double first, double second, double third)
            {
                First = first;
                Second = second;
                Third = third;
            }
        }
    }
}
