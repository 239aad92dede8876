using System;

namespace Geoidx
{
    internal static class StatusExtensions
    {
        internal static void ThrowIfError(this GeodesicStatus status)
        {
            if (status != GeodesicStatus.Ok) throw status.ToException();
        }

        // The detail is that of the calling thread's latest failure.
        internal static Exception ToException(this GeodesicStatus status) =>
            GeodesicException.For(status, NativeText.FromUtf8(NativeMethods.geoidx_last_error()));
    }
}
