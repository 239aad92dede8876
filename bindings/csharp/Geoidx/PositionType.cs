namespace Geoidx
{
    /// <summary>The type of coordinates.</summary>
    public enum PositionType
    {
        /// <summary>Three times 4 bytes a vertex.</summary>
        Float = 0,

        /// <summary>Three times 8 bytes a vertex.</summary>
        Double = 1,
    }
}
