using System;

namespace Geoidx
{
    /// <summary>
    /// The caller's own metric: writes the distance from <paramref name="source"/> to each of
    /// <paramref name="targets"/> into <paramref name="distances"/>, in the mesh's unit. Distances are symmetric, not
    /// negative, obey the triangle inequality, and are infinite where there is no path. It is called from several
    /// threads at once unless <see cref="BuildOptions.Threads"/> is 1. An exception that it throws stops the build and
    /// is thrown on by it.
    /// </summary>
    /// <param name="source">A vertex of the caller's mesh.</param>
    /// <param name="targets">Vertices of the caller's mesh.</param>
    /// <param name="distances">As long as <paramref name="targets"/>.</param>
    public delegate void GeodesicMetric(int source, ReadOnlySpan<int> targets, Span<double> distances);
}
