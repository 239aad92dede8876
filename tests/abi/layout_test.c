/* The layout of every struct of geoidx.h on 64-bit machines, and the number of every constant, as other
 * languages declare them: laid down by hand, since a change breaks programs that exist. C11, for static
 * assertions. */
#include <assert.h>
#include <stddef.h>

#include "geoidx.h"

#define FIELD(type, field, offset) static_assert(offsetof(type, field) == (offset), #type "." #field)
#define SIZE(type, size) static_assert(sizeof(type) == (size), #type)
#define NUMBER(constant, number) static_assert((constant) == (number), #constant)

NUMBER(GEOIDX_OK, 0);
NUMBER(GEOIDX_ERROR_INVALID_ARGUMENT, -1);
NUMBER(GEOIDX_ERROR_IO, -2);
NUMBER(GEOIDX_ERROR_NOT_AN_INDEX, -3);
NUMBER(GEOIDX_ERROR_TRUNCATED, -4);
NUMBER(GEOIDX_ERROR_CORRUPT, -5);
NUMBER(GEOIDX_ERROR_CHECKSUM, -6);
NUMBER(GEOIDX_ERROR_UNSUPPORTED_VERSION, -7);
NUMBER(GEOIDX_ERROR_MESH_MISMATCH, -8);
NUMBER(GEOIDX_ERROR_LIMIT, -9);
NUMBER(GEOIDX_ERROR_OUT_OF_MEMORY, -10);
NUMBER(GEOIDX_ERROR_CANCELLED, -11);
NUMBER(GEOIDX_ERROR_BAD_MESH, -12);
NUMBER(GEOIDX_ERROR_CALLBACK, -13);
NUMBER(GEOIDX_ERROR_INTERNAL, -14);
NUMBER(GEOIDX_ERROR_NO_PATH, -15);
NUMBER(GEOIDX_PATH_STRAIGHT, 0);
NUMBER(GEOIDX_PATH_EXACT, 1);
NUMBER(GEOIDX_ISSUE_MAGIC, 1);
NUMBER(GEOIDX_ISSUE_HEADER_TRUNCATED, 2);
NUMBER(GEOIDX_ISSUE_VERSION, 3);
NUMBER(GEOIDX_ISSUE_FEATURE_FLAGS, 4);
NUMBER(GEOIDX_ISSUE_FILE_TRUNCATED, 5);
NUMBER(GEOIDX_ISSUE_FILE_TOO_LONG, 6);
NUMBER(GEOIDX_ISSUE_SECTION_COUNT, 7);
NUMBER(GEOIDX_ISSUE_SECTION_TABLE, 8);
NUMBER(GEOIDX_ISSUE_SECTION_OUTSIDE, 9);
NUMBER(GEOIDX_ISSUE_SECTION_PLACE, 10);
NUMBER(GEOIDX_ISSUE_SECTION_TWICE, 11);
NUMBER(GEOIDX_ISSUE_SECTION_FLAGS, 12);
NUMBER(GEOIDX_ISSUE_SECTION_UNKNOWN, 13);
NUMBER(GEOIDX_ISSUE_SECTION_CODEC, 14);
NUMBER(GEOIDX_ISSUE_SECTION_SIZE, 15);
NUMBER(GEOIDX_ISSUE_FILE_END, 16);
NUMBER(GEOIDX_ISSUE_HEADER_CHECKSUM, 17);
NUMBER(GEOIDX_ISSUE_PADDING, 18);
NUMBER(GEOIDX_ISSUE_SECTION_CHECKSUM, 19);
NUMBER(GEOIDX_ISSUE_DECODING, 100);
NUMBER(GEOIDX_ISSUE_META, 101);
NUMBER(GEOIDX_ISSUE_HIER, 102);
NUMBER(GEOIDX_ISSUE_VERT, 103);
NUMBER(GEOIDX_ISSUE_POSI, 104);
NUMBER(GEOIDX_ISSUE_BORD, 105);
NUMBER(GEOIDX_ISSUE_BVBV, 106);
NUMBER(GEOIDX_ISSUE_BVIV, 107);
NUMBER(GEOIDX_ISSUE_IVIV, 108);
NUMBER(GEOIDX_ISSUE_QUAN, 109);
NUMBER(GEOIDX_ISSUE_SEGM, 110);
NUMBER(GEOIDX_ISSUE_OVOV, 111);
NUMBER(GEOIDX_ISSUE_HOPS, 112);
NUMBER(GEOIDX_ISSUE_MESH, 113);
NUMBER(GEOIDX_ISSUE_PAIR, 114);
NUMBER(GEOIDX_ISSUE_EDGE, 115);
NUMBER(GEOIDX_ISSUE_WHOLE_INDEX, 200);
NUMBER(GEOIDX_POSITION_FLOAT, 0);
NUMBER(GEOIDX_POSITION_DOUBLE, 1);
NUMBER(GEOIDX_METRIC_EXACT, 0);
NUMBER(GEOIDX_METRIC_EDGES, 1);
NUMBER(GEOIDX_METRIC_CALLBACK, 2);
NUMBER(GEOIDX_METRIC_WEIGHTED, 3);
NUMBER(GEOIDX_METRIC_UNFOLDABLE, 1);
NUMBER(GEOIDX_ENGINE_GRAPH, 0);
NUMBER(GEOIDX_ENGINE_OVERLAY, 1);
NUMBER(GEOIDX_CODEC_PACKED, 0);
NUMBER(GEOIDX_CODEC_LOSSLESS, 1);
NUMBER(GEOIDX_CODEC_MAPPED, 2);
NUMBER(GEOIDX_OPEN_PAIRS, 1);
NUMBER(GEOIDX_OPEN_BORROW, 2);
NUMBER(GEOIDX_OPEN_NO_LABELS, 4);
NUMBER(GEOIDX_SAVE_NO_POSITIONS, 1);
NUMBER(GEOIDX_SAVE_NO_MESH, 2);
NUMBER(GEOIDX_MAX_LEVELS, 8);

FIELD(geoidx_allocator, allocate, 0);
FIELD(geoidx_allocator, release, 8);
FIELD(geoidx_allocator, user, 16);
SIZE(geoidx_allocator, 24);

FIELD(geoidx_mesh, struct_size, 0);
FIELD(geoidx_mesh, position_type, 4);
FIELD(geoidx_mesh, positions, 8);
FIELD(geoidx_mesh, vertex_count, 16);
FIELD(geoidx_mesh, triangles, 24);
FIELD(geoidx_mesh, triangle_count, 32);
FIELD(geoidx_mesh, position_stride, 40);
FIELD(geoidx_mesh, reserved, 44);
SIZE(geoidx_mesh, 48);

FIELD(geoidx_build_options, struct_size, 0);
FIELD(geoidx_build_options, metric, 4);
FIELD(geoidx_build_options, weld_tolerance, 8);
FIELD(geoidx_build_options, delta, 16);
FIELD(geoidx_build_options, seed, 24);
FIELD(geoidx_build_options, threads, 32);
FIELD(geoidx_build_options, level_count, 36);
FIELD(geoidx_build_options, patches, 40);
FIELD(geoidx_build_options, lloyd_iterations, 72);
FIELD(geoidx_build_options, edge_cost_count, 76);
FIELD(geoidx_build_options, edge_cost_vertices, 80);
FIELD(geoidx_build_options, edge_costs, 88);
FIELD(geoidx_build_options, metric_callback, 96);
FIELD(geoidx_build_options, metric_user, 104);
FIELD(geoidx_build_options, progress, 112);
FIELD(geoidx_build_options, progress_user, 120);
FIELD(geoidx_build_options, allocator, 128);
FIELD(geoidx_build_options, refuse_edges_of_many, 152);
FIELD(geoidx_build_options, metric_flags, 156);
FIELD(geoidx_build_options, face_costs, 160);
FIELD(geoidx_build_options, face_cost_count, 168);
FIELD(geoidx_build_options, points_per_edge, 176);
FIELD(geoidx_build_options, engine, 180);
FIELD(geoidx_build_options, edge_lengths, 184);
FIELD(geoidx_build_options, edge_length_count, 192);
FIELD(geoidx_build_options, exact_vertices, 200);
FIELD(geoidx_build_options, reserved, 204);
FIELD(geoidx_build_options, rounding, 208);
FIELD(geoidx_build_options, target_error, 216);
FIELD(geoidx_build_options, store_mesh, 224);
FIELD(geoidx_build_options, reserved_at_end, 228);
FIELD(geoidx_build_options, solver_tolerance, 232);
SIZE(geoidx_build_options, 240);

FIELD(geoidx_open_options, struct_size, 0);
FIELD(geoidx_open_options, flags, 4);
FIELD(geoidx_open_options, expected_mesh, 8);
FIELD(geoidx_open_options, allocator, 16);
FIELD(geoidx_open_options, threads, 40);
FIELD(geoidx_open_options, reserved, 44);
FIELD(geoidx_open_options, max_vertices, 48);
FIELD(geoidx_open_options, max_memory, 56);
SIZE(geoidx_open_options, 64);

FIELD(geoidx_info, struct_size, 0);
FIELD(geoidx_info, metric, 4);
FIELD(geoidx_info, vertex_count, 8);
FIELD(geoidx_info, triangle_count, 16);
FIELD(geoidx_info, welded_vertex_count, 24);
FIELD(geoidx_info, mesh_fingerprint, 32);
FIELD(geoidx_info, table_entries, 40);
FIELD(geoidx_info, border_vertex_count, 48);
FIELD(geoidx_info, bounding_box_diagonal, 56);
FIELD(geoidx_info, delta, 64);
FIELD(geoidx_info, seed, 72);
FIELD(geoidx_info, format_major, 80);
FIELD(geoidx_info, format_minor, 84);
FIELD(geoidx_info, level_count, 88);
FIELD(geoidx_info, patch_count, 92);
FIELD(geoidx_info, error_sources, 124);
FIELD(geoidx_info, error_mean, 128);
FIELD(geoidx_info, error_signed_mean, 136);
FIELD(geoidx_info, error_p99, 144);
FIELD(geoidx_info, error_p999, 152);
FIELD(geoidx_info, error_max, 160);
FIELD(geoidx_info, metric_fingerprint, 168);
FIELD(geoidx_info, metric_flags, 176);
FIELD(geoidx_info, engine, 180);
FIELD(geoidx_info, error_mean_at_vertices, 184);
FIELD(geoidx_info, codec, 192);
FIELD(geoidx_info, file_flags, 196);
FIELD(geoidx_info, smallest_step, 200);
FIELD(geoidx_info, largest_step, 208);
FIELD(geoidx_info, added_vertex_count, 216);
FIELD(geoidx_info, error_near_mean, 224);
FIELD(geoidx_info, error_near_max, 232);
FIELD(geoidx_info, error_middle_mean, 240);
FIELD(geoidx_info, error_middle_max, 248);
FIELD(geoidx_info, error_far_mean, 256);
FIELD(geoidx_info, error_far_max, 264);
FIELD(geoidx_info, error_several_mean, 272);
FIELD(geoidx_info, error_several_max, 280);
FIELD(geoidx_info, has_mesh, 288);
FIELD(geoidx_info, reserved, 292);
SIZE(geoidx_info, 296);

FIELD(geoidx_save_options, struct_size, 0);
FIELD(geoidx_save_options, codec, 4);
FIELD(geoidx_save_options, flags, 8);
FIELD(geoidx_save_options, reserved, 12);
SIZE(geoidx_save_options, 16);

FIELD(geoidx_section, tag, 0);
FIELD(geoidx_section, coding, 8);
FIELD(geoidx_section, reserved, 12);
FIELD(geoidx_section, offset, 16);
FIELD(geoidx_section, stored_size, 24);
FIELD(geoidx_section, raw_size, 32);
SIZE(geoidx_section, 40);

FIELD(geoidx_issue, number, 0);
FIELD(geoidx_issue, status, 4);
FIELD(geoidx_issue, offset, 8);
FIELD(geoidx_issue, message, 16);
SIZE(geoidx_issue, 24);

FIELD(geoidx_surface_point, triangle, 0);
FIELD(geoidx_surface_point, reserved, 4);
FIELD(geoidx_surface_point, weights, 8);
SIZE(geoidx_surface_point, 32);

FIELD(geoidx_surface_options, struct_size, 0);
FIELD(geoidx_surface_options, reserved, 4);
FIELD(geoidx_surface_options, weld_tolerance, 8);
FIELD(geoidx_surface_options, edge_cost_vertices, 16);
FIELD(geoidx_surface_options, edge_costs, 24);
FIELD(geoidx_surface_options, face_costs, 32);
FIELD(geoidx_surface_options, face_cost_count, 40);
FIELD(geoidx_surface_options, edge_cost_count, 48);
FIELD(geoidx_surface_options, points_per_edge, 52);
SIZE(geoidx_surface_options, 56);

FIELD(geoidx_path_point, point, 0);
FIELD(geoidx_path_point, position, 32);
SIZE(geoidx_path_point, 56);
