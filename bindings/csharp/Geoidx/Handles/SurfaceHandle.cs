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

        protected override void CloseNative() => NativeMethods.geoidx_surface_close(handle);
    }
}
