using System;

namespace Geoidx
{
    /// <summary>What a distance is.</summary>
    public enum MetricKind
    {
        /// <summary>The exact polyhedral geodesic distance.</summary>
        Exact = 0,

        /// <summary>The shortest path along edges, by their length or <see cref="BuildOptions.EdgeCosts"/>.</summary>
        Edges = 1,

        /// <summary>What <see cref="BuildOptions.MetricCallback"/> says.</summary>
        Callback = 2,

        /// <summary>
        /// The length of a path in each triangle times its <see cref="BuildOptions.FaceCosts"/>, approximated from
        /// above.
        /// </summary>
        Weighted = 3,
    }

    /// <summary>Properties of a metric.</summary>
    [Flags]
    public enum MetricFlags
    {
        /// <summary>None but those of every metric.</summary>
        None = 0,

        /// <summary>
        /// Small pieces of the surface can be laid out in the plane with their distances kept, so that a path may be
        /// taken to cross an edge anywhere and straight.
        /// </summary>
        Unfoldable = 1,
    }
}
