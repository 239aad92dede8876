using System;
using System.Runtime.InteropServices;

namespace Geoidx
{
    internal static class NativeText
    {
        internal static string FromUtf8(IntPtr text) => Marshal.PtrToStringUTF8(text) ?? "";

        /// <summary>A path that C reads to its end.</summary>
        internal static string CheckedPath(string path)
        {
            if (path == null) throw new ArgumentNullException(nameof(path));
            if (path.IndexOf('\0') >= 0) throw new GeodesicArgumentException("The path contains a NUL.");
            return path;
        }
    }
}
