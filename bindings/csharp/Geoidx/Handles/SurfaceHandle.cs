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
            return Create(mesh, options);
        }

        internal static SurfaceHandle Create(NativeMesh mesh, in NativeBuildOptions ofIndex) =>
            Create(mesh, OptionsFor(ofIndex));

        private static NativeSurfaceOptions OptionsFor(in NativeBuildOptions ofIndex)
        {
            NativeSurfaceOptions options = NativeDefaults.SurfaceOptions();
            options.weld_tolerance = ofIndex.weld_tolerance;
            options.edge_cost_vertices = ofIndex.edge_cost_vertices;
            options.edge_costs = ofIndex.edge_costs;
            options.edge_cost_count = ofIndex.edge_cost_count;
            options.face_costs = ofIndex.face_costs;
            options.face_cost_count = ofIndex.face_cost_count;
            options.points_per_edge = ofIndex.points_per_edge;
            return options;
        }

        private static SurfaceHandle Create(NativeMesh mesh, NativeSurfaceOptions options)
        {
            GeodesicStatus status = NativeMethods.geoidx_surface_create(&mesh, &options, out IntPtr surface);
            if (status == GeodesicStatus.Ok) return new SurfaceHandle(surface);
            throw status.ToExceptionOfOptions();
        }

        internal static SurfaceHandle Of(IndexHandle index)
        {
            GeodesicStatus status = NativeMethods.geoidx_surface_of_index(index, null, out IntPtr surface);
            if (status == GeodesicStatus.Ok) return new SurfaceHandle(surface);
            throw status.ToException();
        }

        internal static SurfaceHandle Of(IndexHandle index, in NativeBuildOptions ofIndex)
        {
            NativeSurfaceOptions options = OptionsFor(ofIndex);
            GeodesicStatus status = NativeMethods.geoidx_surface_of_index(index, &options, out IntPtr surface);
            if (status == GeodesicStatus.Ok) return new SurfaceHandle(surface);
            throw status.ToExceptionOfOptions();
        }

        protected override void CloseNative() => NativeMethods.geoidx_surface_close(handle);
    }
}
