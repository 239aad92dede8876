using System;

namespace Geoidx
{
    internal sealed unsafe class SurfaceHandle : OwnedHandle
    {
        private SurfaceHandle(IntPtr surface) : base(null) => SetHandle(surface);

        internal static SurfaceHandle Create(NativeMesh mesh, double weldTolerance)
        {
            NativeSurfaceOptions options = NativeDefaults.SurfaceOptions();
            options.weld_tolerance = weldTolerance;
            GeodesicStatus status = NativeMethods.geoidx_surface_create(&mesh, &options, out IntPtr surface);
            if (status == GeodesicStatus.Ok) return new SurfaceHandle(surface);
            throw status.ToExceptionOfOptions();
        }

        internal static SurfaceHandle Of(IndexHandle index)
        {
            GeodesicStatus status = NativeMethods.geoidx_surface_of_index(index, out IntPtr surface);
            if (status == GeodesicStatus.Ok) return new SurfaceHandle(surface);
            throw status.ToException();
        }

        protected override void CloseNative() => NativeMethods.geoidx_surface_close(handle);
    }
}
