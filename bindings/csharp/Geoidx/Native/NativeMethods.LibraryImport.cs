#if NET
using System;
using System.Runtime.InteropServices;

namespace Geoidx
{
    internal static unsafe partial class NativeMethods
    {
        internal const string Library = "geoidx";

        [LibraryImport(Library)]
        internal static partial uint geoidx_version();

        [LibraryImport(Library)]
        internal static partial uint geoidx_abi_version();

        [LibraryImport(Library)]
        internal static partial IntPtr geoidx_status_string(GeodesicStatus status);

        [LibraryImport(Library)]
        internal static partial IntPtr geoidx_last_error();

        [LibraryImport(Library)]
        internal static partial void geoidx_mesh_init_sized(void* mesh, uint struct_size);

        [LibraryImport(Library)]
        internal static partial void geoidx_build_options_init_sized(void* options, uint struct_size);

        [LibraryImport(Library)]
        internal static partial void geoidx_open_options_init_sized(void* options, uint struct_size);

        [LibraryImport(Library)]
        internal static partial void geoidx_save_options_init_sized(void* options, uint struct_size);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_build(
            NativeMesh* mesh, NativeBuildOptions* options, out IntPtr index);

        [LibraryImport(Library, StringMarshalling = StringMarshalling.Utf8)]
        internal static partial GeodesicStatus geoidx_save(
            IndexHandle index, string utf8_path, NativeSaveOptions* options);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_save_memory(
            IndexHandle index, NativeSaveOptions* options, byte* buffer, ulong capacity, out ulong needed);

        [LibraryImport(Library, StringMarshalling = StringMarshalling.Utf8)]
        internal static partial GeodesicStatus geoidx_open(
            string utf8_path, NativeOpenOptions* options, out IntPtr index);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_open_memory(
            byte* data, ulong size, NativeOpenOptions* options, out IntPtr index);

        [LibraryImport(Library)]
        internal static partial void geoidx_close(IntPtr index);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_get_info(IndexHandle index, NativeInfo* info);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_get_sections(
            IndexHandle index, NativeSection* sections, uint capacity, out uint count);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_verify(
            byte* data, ulong size, IntPtr issue, IntPtr user);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_sssd(
            IndexHandle index, int source, int target, out float distance);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_sssd_batch(
            IndexHandle index, VertexPair* source_target_pairs, ulong pair_count, float* distances);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_msad(
            IndexHandle index, int* sources, uint source_count, float* distances, uint distance_count);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_ssad_batch(
            IndexHandle index, int* sources, uint source_count, float* distances, ulong distance_count);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_matrix(
            IndexHandle index, int* sources, uint source_count, int* targets, uint target_count,
            float* distances, ulong distance_count);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_create(IndexHandle index, out IntPtr query);

        [LibraryImport(Library)]
        internal static partial void geoidx_query_close(IntPtr query);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_sssd(
            QueryHandle query, int source, int target, out float distance);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_msad(
            QueryHandle query, int* sources, uint source_count, float* distances, uint distance_count);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_ssad_batch(
            QueryHandle query, int* sources, uint source_count, float* distances, ulong distance_count);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_msad_within(
            QueryHandle query, int* sources, uint source_count, float radius, float* distances,
            uint distance_count);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_matrix(
            QueryHandle query, int* sources, uint source_count, int* targets, uint target_count,
            float* distances, ulong distance_count);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_nearest_sources(
            QueryHandle query, int* sources, uint source_count, int* nearest, float* distances,
            uint vertex_count);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_within(
            QueryHandle query, int* sources, uint source_count, float radius, int* vertices, float* distances,
            uint capacity, out uint count);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_nearest_targets(
            QueryHandle query, int source, int* targets, uint target_count, int* positions, float* distances,
            uint capacity, out uint count);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_farthest_points(
            QueryHandle query, int* sources, uint source_count, uint point_count, int* points, float* distances,
            out uint count);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_set_threads(QueryHandle query, uint threads);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_prepare(QueryHandle query, int source);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_prepared(
            QueryHandle query, int* targets, ulong target_count, float* distances);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_solver_create(
            NativeMesh* mesh, NativeBuildOptions* options, out IntPtr solver);

        [LibraryImport(Library)]
        internal static partial void geoidx_solver_close(IntPtr solver);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_solver_distances(
            SolverHandle solver, int* sources, uint source_count, int* targets, uint target_count,
            double* distances);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_solver_point_distances(
            SolverHandle solver, SurfacePoint* sources, uint source_count, SurfacePoint* targets,
            uint target_count, double* distances);

        [LibraryImport(Library)]
        internal static partial void geoidx_surface_options_init_sized(
            void* options, uint struct_size);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_surface_create(
            NativeMesh* mesh, NativeSurfaceOptions* options, out IntPtr surface);

        [LibraryImport(Library)]
        internal static partial void geoidx_surface_close(
            IntPtr surface);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_surface_of_index(
            IndexHandle index, NativeSurfaceOptions* options, out IntPtr surface);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_vertex_point(
            SurfaceHandle surface, int vertex, SurfacePoint* point);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_closest_point(
            SurfaceHandle surface, double* position, SurfacePoint* point, double* distance);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_point_sssd(
            QueryHandle query, SurfaceHandle surface, SurfacePoint* source, SurfacePoint* target,
            out float distance);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_point_msad(
            QueryHandle query, SurfaceHandle surface, SurfacePoint* sources, uint source_count,
            float* offsets, float* distances, uint distance_count);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_point_nearest_sources(
            QueryHandle query, SurfaceHandle surface, SurfacePoint* sources, uint source_count,
            float* offsets, int* nearest, float* distances, uint vertex_count);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_point_within(
            QueryHandle query, SurfaceHandle surface, SurfacePoint* sources, uint source_count,
            float* offsets, float radius, int* vertices, float* distances, uint capacity, out uint count);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_point_nearest_targets(
            QueryHandle query, SurfaceHandle surface, SurfacePoint* source, SurfacePoint* targets,
            uint target_count, int* positions, float* distances, uint capacity, out uint count);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_path(
            QueryHandle query, SurfaceHandle surface, SurfacePoint* source, SurfacePoint* target,
            PathQuality quality, out double length);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_path_points(
            QueryHandle query, PathPoint* points, ulong capacity, out ulong count);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_prepare_target(
            QueryHandle query, SurfaceHandle surface, SurfacePoint* target);

        [LibraryImport(Library)]
        internal static partial GeodesicStatus geoidx_query_next_step(
            QueryHandle query, SurfaceHandle surface, SurfacePoint* from, PathPoint* step, out double distance);
    }
}
#endif
