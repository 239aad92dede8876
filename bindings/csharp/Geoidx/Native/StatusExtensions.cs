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
        internal static Exception ToException(this GeodesicStatus status)
        {
            string detail = LatestDetail();
            if (IsOfArguments(status)) detail = NativeMessage.OfArguments(detail);
            if (status == GeodesicStatus.Limit) detail = NativeMessage.OfLimits(detail);
            return GeodesicException.For(status, detail);
        }

        /// <summary>After a call that takes <see cref="BuildOptions"/>.</summary>
        internal static Exception ToExceptionOfOptions(this GeodesicStatus status)
        {
            string detail = LatestDetail();
            return GeodesicException.For(status, IsOfArguments(status) ? NativeMessage.OfOptions(detail) : detail);
        }

        // Others are of files, whose numbers have no sign and whose names are anything.
        private static bool IsOfArguments(GeodesicStatus status) =>
            status == GeodesicStatus.InvalidArgument || status == GeodesicStatus.BadMesh ||
            status == GeodesicStatus.Callback;

        private static string LatestDetail() => NativeText.FromUtf8(NativeMethods.geoidx_last_error());
    }
}
