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
    }
}
