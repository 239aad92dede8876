namespace Geoidx
{
    /// <summary>How the bytes of a section are stored.</summary>
    public enum SectionCoding
    {
        /// <summary>As they are.</summary>
        Raw = 0,

        /// <summary>Compressed by zstd.</summary>
        Zstd = 1,

        /// <summary>A PNG for each matrix.</summary>
        Png = 2,

        /// <summary>Gray PNG images.</summary>
        Images = 3,
    }
}
