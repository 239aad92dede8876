using System;

namespace Geoidx
{
    /// <summary>The native library cannot be loaded, or its version does not fit this assembly.</summary>
    public sealed class GeodesicLibraryException : Exception
    {
        internal GeodesicLibraryException(string message, Exception? cause = null) : base(message, cause) { }
    }
}
