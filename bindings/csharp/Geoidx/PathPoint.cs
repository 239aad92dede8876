using System;
using System.Runtime.InteropServices;

namespace Geoidx
{
    /// <summary>A point of a path: on a triangle of the caller's mesh, and in space.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public readonly struct PathPoint
    {
        private readonly SurfacePoint point;
        private readonly Coordinates position;

        /// <summary>Triangle and weights. The piece to the next point lies on this triangle.</summary>
        public SurfacePoint Point => point;

        /// <summary>Its first coordinate.</summary>
        public double X => position.First;

        /// <summary>Its second coordinate.</summary>
        public double Y => position.Second;

        /// <summary>Its third coordinate.</summary>
        public double Z => position.Third;

        /// <summary>The position, triangle and weights.</summary>
        public override string ToString() => FormattableString.Invariant($"({X}, {Y}, {Z}) on {Point}");

        [StructLayout(LayoutKind.Sequential)]
        private readonly struct Coordinates
        {
            internal readonly double First;
            internal readonly double Second;
            internal readonly double Third;
        }
    }
}
