namespace Geoidx
{
    /// <summary>The outcome of a call into the native library.</summary>
    public enum GeodesicStatus
    {
        /// <summary>Success.</summary>
        Ok = 0,

        /// <summary>A vertex or an option is out of range, or something needed is missing.</summary>
        InvalidArgument = -1,

        /// <summary>The operating system refused to open, read, write or rename.</summary>
        IO = -2,

        /// <summary>The data does not begin like an index.</summary>
        NotAnIndex = -3,

        /// <summary>The data is shorter than its header says.</summary>
        Truncated = -4,

        /// <summary>The data contradicts the format or itself.</summary>
        Corrupt = -5,

        /// <summary>Stored bytes do not match their checksum.</summary>
        Checksum = -6,

        /// <summary>Written by a newer format, or with features unknown here.</summary>
        UnsupportedVersion = -7,

        /// <summary>The index belongs to another mesh than the one given.</summary>
        MeshMismatch = -8,

        /// <summary>A count is over what the format or the library can hold.</summary>
        Limit = -9,

        /// <summary>There was not enough memory.</summary>
        OutOfMemory = -10,

        /// <summary>A build was cancelled.</summary>
        Cancelled = -11,

        /// <summary>The mesh cannot be used; the detail names the element.</summary>
        BadMesh = -12,

        /// <summary>The caller's metric failed, or gave NaN or a negative number.</summary>
        Callback = -13,

        /// <summary>A defect of the native library.</summary>
        Internal = -14,

        /// <summary>No path on the surface joins the two points.</summary>
        NoPath = -15,
    }
}
