namespace Geoidx
{
    /// <summary>Structs as the native library sets them up.</summary>
    internal static unsafe class NativeDefaults
    {
        // A newer library fills its own, longer struct.
        private const int Room = 256;

        internal static NativeMesh Mesh()
        {
            ulong* room = stackalloc ulong[Room];
            NativeMethods.geoidx_mesh_init(room);
            NativeMesh mesh = *(NativeMesh*)room;
            mesh.struct_size = (uint)sizeof(NativeMesh);
            return mesh;
        }

        internal static NativeBuildOptions BuildOptions()
        {
            ulong* room = stackalloc ulong[Room];
            NativeMethods.geoidx_build_options_init(room);
            NativeBuildOptions options = *(NativeBuildOptions*)room;
            options.struct_size = (uint)sizeof(NativeBuildOptions);
            return options;
        }

        internal static NativeOpenOptions OpenOptions()
        {
            ulong* room = stackalloc ulong[Room];
            NativeMethods.geoidx_open_options_init(room);
            NativeOpenOptions options = *(NativeOpenOptions*)room;
            options.struct_size = (uint)sizeof(NativeOpenOptions);
            return options;
        }
    }
}
