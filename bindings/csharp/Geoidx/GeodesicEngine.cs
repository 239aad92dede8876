namespace Geoidx
{
    /// <summary>How an index answers.</summary>
    public enum GeodesicEngine
    {
        /// <summary>
        /// A search over the tables of every patch's border. Paths cross borders at vertices, so that distances are
        /// never below the metric's.
        /// </summary>
        Graph = 0,

        /// <summary>
        /// A fixed sequence of min-plus products of overlay tables, 16 bits an entry. Distances may be a little below
        /// the metric's, where that is <see cref="MetricFlags.Unfoldable"/>.
        /// </summary>
        Overlay = 1,
    }
}
