using System;
using System.Collections.Generic;

namespace Geoidx.Tests
{
    /// <summary>Meshes whose distances are known in closed form.</summary>
    internal static class Shapes
    {
        /// <summary>Side x side vertices, one unit apart, vertex y * side + x at (x, y, 0).</summary>
        internal static (float[] Positions, int[] Triangles) PlaneArrays(int side)
        {
            var positions = new List<float>();
            for (int v = 0; v < side * side; v++) positions.AddRange(new float[] { v % side, v / side, 0 });
            var triangles = new List<int>();
            for (int y = 0; y + 1 < side; y++)
            {
                for (int x = 0; x + 1 < side; x++)
                {
                    int v = y * side + x;
                    triangles.AddRange(new[] { v, v + 1, v + side + 1, v, v + side + 1, v + side });
                }
            }
            return (positions.ToArray(), triangles.ToArray());
        }

        internal static GeodesicMesh Plane(int side)
        {
            (float[] positions, int[] triangles) = PlaneArrays(side);
            return GeodesicMesh.From(positions, triangles);
        }

        internal static double PlaneDistance(int side, int a, int b)
        {
            int x = a % side - b % side, y = a / side - b / side;
            return Math.Sqrt(x * x + y * y);
        }

        /// <summary>A unit square of two triangles, (0, 0), (1, 0), (1, 1), (0, 1), along the diagonal 0 - 2.</summary>
        internal static GeodesicMesh Square() =>
            GeodesicMesh.From(new double[] { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 }, new[] { 0, 1, 2, 0, 2, 3 });

        /// <summary>Two triangles of their own, 5 apart along x.</summary>
        internal static GeodesicMesh TwoTriangles() =>
            GeodesicMesh.From(
                new double[] { 0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0 }, new[] { 0, 1, 2, 3, 4, 5 });

        /// <summary>A unit cube, vertex 4 z + 2 y + x at (x, y, z).</summary>
        internal static GeodesicMesh Cube()
        {
            var positions = new float[24];
            for (int v = 0; v < 8; v++)
                for (int axis = 0; axis < 3; axis++)
                    positions[3 * v + axis] = v >> axis & 1;
            return GeodesicMesh.From(
                positions,
                new[]
                {
                    0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                    2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5,
                });
        }

        /// <summary>
        /// A cone of slant height 1, vertex 0 its apex, 1 .. sides its rim; each triangle has this angle at the apex.
        /// </summary>
        internal static GeodesicMesh Cone(int sides, double apexAngle)
        {
            double radius = Math.Sin(apexAngle / 2) / Math.Sin(Math.PI / sides);
            double height = Math.Sqrt(1 - radius * radius);
            var positions = new List<double> { 0, 0, height };
            var triangles = new List<int>();
            for (int i = 0; i < sides; i++)
            {
                double turn = 2 * Math.PI * i / sides;
                positions.AddRange(new[] { radius * Math.Cos(turn), radius * Math.Sin(turn), 0 });
                triangles.AddRange(new[] { 0, 1 + i, 1 + (i + 1) % sides });
            }
            return GeodesicMesh.From(positions.ToArray(), triangles.ToArray());
        }

        /// <summary>
        /// Between rim vertices so many triangles apart, the shorter way: a chord of the unrolled cone.
        /// </summary>
        internal static double RimDistance(double apexAngle, int triangles) =>
            triangles * apexAngle >= Math.PI ? 2 : 2 * Math.Sin(triangles * apexAngle / 2);
    }
}
