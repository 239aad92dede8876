namespace Geoidx
{
    /// <summary>Structs as the native library sets them up.</summary>
    internal static unsafe class NativeDefaults
    {
        internal static NativeMesh Mesh()
        {
            NativeMesh mesh = default;
            NativeMethods.geoidx_mesh_init_sized(&mesh, (uint)sizeof(NativeMesh));
            return mesh;
        }

        internal static NativeBuildOptions BuildOptions()
        {
            NativeBuildOptions options = default;
            NativeMethods.geoidx_build_options_init_sized(&options, (uint)sizeof(NativeBuildOptions));
            return options;
        }

        internal static NativeOpenOptions OpenOptions()
        {
            NativeOpenOptions options = default;
            NativeMethods.geoidx_open_options_init_sized(&options, (uint)sizeof(NativeOpenOptions));
            return options;
        }

        internal static NativeSurfaceOptions SurfaceOptions()
        {
            NativeSurfaceOptions options = default;
            NativeMethods.geoidx_surface_options_init_sized(&options, (uint)sizeof(NativeSurfaceOptions));
            return options;
        }

        internal static NativeSaveOptions SaveOptions()
        {
            NativeSaveOptions options = default;
            NativeMethods.geoidx_save_options_init_sized(&options, (uint)sizeof(NativeSaveOptions));
            return options;
        }
    }
}
