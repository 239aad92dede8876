using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Geoidx
{
    internal static class NativeText
    {
        private static readonly Encoding Strict =
            new UTF8Encoding(encoderShouldEmitUTF8Identifier: false, throwOnInvalidBytes: true);

        internal static string FromUtf8(IntPtr text) => Marshal.PtrToStringUTF8(text) ?? "";

        /// <summary>A path that C reads to its end and as it is.</summary>
        internal static string CheckedPath(string path)
        {
            if (path == null) throw new ArgumentNullException(nameof(path));
            if (path.IndexOf('\0') >= 0) throw new GeodesicArgumentException("The path contains a NUL.");
            if (!HasUtf8(path)) throw new ArgumentException("The path has half of a surrogate pair.", nameof(path));
            return path;
        }

        private static bool HasUtf8(string text)
        {
            try
            {
                Strict.GetByteCount(text);
                return true;
            }
            catch (EncoderFallbackException)
            {
                return false;
            }
        }
    }
}
