namespace Geoidx
{
    /// <summary>The form that a file keeps distances in. Answers are the same bits in each.</summary>
    public enum GeodesicCodec
    {
        /// <summary>
        /// The smallest file: what is left of distances when they are predicted from the positions of their vertices
        /// and from each other, as gray PNG images.
        /// </summary>
        Packed = 0,

        /// <summary>
        /// A PNG of floats for each table. Indices of <see cref="GeodesicEngine.Graph"/> are always saved like this.
        /// </summary>
        Lossless = 1,

        /// <summary>
        /// The tables as queries read them, uncompressed: more than ten times as large as <see cref="Packed"/>, but
        /// nothing is left to do when the file is opened. Opening it by its path maps it instead of reading it, so that
        /// processes share one copy in memory. As long as the index is open, nobody may write into the file or cut it
        /// short. Saving over it replaces it, which does no harm; only on Windows it fails.
        /// </summary>
        Mapped = 2,
    }
}
