namespace Geoidx
{
    /// <summary>How short a path is.</summary>
    public enum PathQuality
    {
        /// <summary>
        /// Locally shortest: no vertex that it passes can be passed on a shorter side. Never shorter than the distance,
        /// and mostly equal to it.
        /// </summary>
        Straight = 0,

        /// <summary>A shortest path, looked for where the index allows one; takes longer.</summary>
        Exact = 1,
    }
}
