using System;
using System.Runtime.InteropServices;

// Fields are named as in geoidx.h.

namespace Geoidx
{
    [StructLayout(LayoutKind.Sequential)]
    internal struct NativeAllocator
    {
        internal IntPtr allocate;
        internal IntPtr release;
        internal IntPtr user;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeMesh
    {
        internal uint struct_size;
        internal uint position_type;
        internal void* positions;
        internal ulong vertex_count;
        internal int* triangles;
        internal ulong triangle_count;
        internal uint position_stride;
        internal uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeBuildOptions
    {
        internal uint struct_size;
        internal uint metric;
        internal double weld_tolerance;
        internal double delta;
        internal ulong seed;
        internal uint threads;
        internal uint level_count;
        internal fixed uint patches[8];
        internal uint lloyd_iterations;
        internal uint edge_cost_count;
        internal int* edge_cost_vertices;
        internal double* edge_costs;
        internal IntPtr metric_callback;
        internal IntPtr metric_user;
        internal IntPtr progress;
        internal IntPtr progress_user;
        internal NativeAllocator allocator;
        internal uint refuse_edges_of_many;
        internal uint metric_flags;
        internal double* face_costs;
        internal ulong face_cost_count;
        internal uint points_per_edge;
        internal uint engine;
        internal double* edge_lengths;
        internal ulong edge_length_count;
        internal uint exact_vertices;
        internal uint reserved;
        internal double rounding;
        internal double target_error;
        internal uint store_mesh;
        internal uint reserved_at_end;
        internal double solver_tolerance;
    }

    // Borrow is never passed: it is for memory that stays in place until the index is closed, which a span is not.
    internal enum OpenFlags
    {
        Pairs = 1,
        Borrow = 2,
        NoLabels = 4,
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeOpenOptions
    {
        internal uint struct_size;
        internal uint flags;
        internal NativeMesh* expected_mesh;
        internal NativeAllocator allocator;
        internal uint threads;
        internal uint reserved;
        internal ulong max_vertices;
        internal ulong max_memory;
    }

    internal enum SaveFlags
    {
        NoPositions = 1,
        NoMesh = 2,
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeSurfaceOptions
    {
        internal uint struct_size;
        internal uint reserved;
        internal double weld_tolerance;
        internal int* edge_cost_vertices;
        internal double* edge_costs;
        internal double* face_costs;
        internal ulong face_cost_count;
        internal uint edge_cost_count;
        internal uint points_per_edge;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal struct NativeSaveOptions
    {
        internal uint struct_size;
        internal uint codec;
        internal uint flags;
        internal uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeInfo
    {
        internal uint struct_size;
        internal uint metric;
        internal ulong vertex_count;
        internal ulong triangle_count;
        internal ulong welded_vertex_count;
        internal ulong mesh_fingerprint;
        internal ulong table_entries;
        internal ulong border_vertex_count;
        internal double bounding_box_diagonal;
        internal double delta;
        internal ulong seed;
        internal uint format_major;
        internal uint format_minor;
        internal uint level_count;
        internal fixed uint patch_count[8];
        internal uint error_sources;
        internal double error_mean;
        internal double error_signed_mean;
        internal double error_p99;
        internal double error_p999;
        internal double error_max;
        internal ulong metric_fingerprint;
        internal uint metric_flags;
        internal uint engine;
        internal double error_mean_at_vertices;
        internal uint codec;
        internal uint file_flags;
        internal double smallest_step;
        internal double largest_step;
        internal ulong added_vertex_count;
        internal double error_near_mean;
        internal double error_near_max;
        internal double error_middle_mean;
        internal double error_middle_max;
        internal double error_far_mean;
        internal double error_far_max;
        internal double error_several_mean;
        internal double error_several_max;
        internal uint has_mesh;
        internal uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeSection
    {
        internal fixed byte tag[8];
        internal uint coding;
        internal uint reserved;
        internal ulong offset;
        internal ulong stored_size;
        internal ulong raw_size;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal struct NativeIssue
    {
        internal uint number;
        internal int status;
        internal ulong offset;
        internal IntPtr message;
    }
}
