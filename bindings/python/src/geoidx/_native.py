"""The C API as it stands in geoidx.h: structs, callback types, functions, and the library that holds them."""

from __future__ import annotations

import os
from ctypes import (
    CDLL,
    CFUNCTYPE,
    POINTER,
    Structure,
    c_char,
    c_char_p,
    c_double,
    c_float,
    c_int32,
    c_uint32,
    c_uint64,
    c_void_p,
)
from pathlib import Path

HEADER_VERSION = (0, 1, 0)
"""The release whose header this module mirrors."""

ABI_VERSION = 0
"""The binary interface of that header."""

MAX_LEVELS = 8
POSITION_FLOAT = 0
POSITION_DOUBLE = 1
METRIC_UNFOLDABLE = 1
OPEN_PAIRS = 1
OPEN_BORROW = 2
OPEN_NO_LABELS = 4
SAVE_NO_POSITIONS = 1
SAVE_NO_MESH = 2

NO_SOURCE = 0xFFFFFFFF
"""What `nearest` gives for a vertex that no source reaches."""

AllocateFn = CFUNCTYPE(c_void_p, c_void_p, c_uint64, c_uint64)
ReleaseFn = CFUNCTYPE(None, c_void_p, c_void_p, c_uint64, c_uint64)
MetricFn = CFUNCTYPE(c_int32, c_void_p, c_uint32, c_void_p, c_uint32, c_void_p)
ProgressFn = CFUNCTYPE(c_int32, c_void_p, c_float, c_char_p)


class Allocator(Structure):
    """Memory of the caller's choosing, for an index and its queries (not for building and opening).

    `allocate(user, size, alignment)` and `release(user, memory, size, alignment)` are C functions: those of
    another library, or Python functions wrapped in `AllocateFn` and `ReleaseFn`. Both are called from several
    threads at once and must not call geoidx. An index keeps its allocator alive.
    """

    _fields_ = [("allocate", AllocateFn), ("release", ReleaseFn), ("user", c_void_p)]


class Mesh(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("position_type", c_uint32),
        ("positions", c_void_p),
        ("vertex_count", c_uint64),
        ("triangles", c_void_p),
        ("triangle_count", c_uint64),
        ("position_stride", c_uint32),
        ("reserved", c_uint32),
    ]


class BuildOptions(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("metric", c_uint32),
        ("weld_tolerance", c_double),
        ("delta", c_double),
        ("seed", c_uint64),
        ("threads", c_uint32),
        ("level_count", c_uint32),
        ("patches", c_uint32 * MAX_LEVELS),
        ("lloyd_iterations", c_uint32),
        ("edge_cost_count", c_uint32),
        ("edge_cost_vertices", c_void_p),
        ("edge_costs", c_void_p),
        ("metric_callback", MetricFn),
        ("metric_user", c_void_p),
        ("progress", ProgressFn),
        ("progress_user", c_void_p),
        ("allocator", Allocator),
        ("refuse_edges_of_many", c_uint32),
        ("metric_flags", c_uint32),
        ("face_costs", c_void_p),
        ("face_cost_count", c_uint64),
        ("points_per_edge", c_uint32),
        ("engine", c_uint32),
        ("edge_lengths", c_void_p),
        ("edge_length_count", c_uint64),
        ("exact_vertices", c_uint32),
        ("reserved", c_uint32),
        ("rounding", c_double),
        ("target_error", c_double),
        ("store_mesh", c_uint32),
        ("reserved_at_end", c_uint32),
        ("solver_tolerance", c_double),
    ]


class OpenOptions(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("flags", c_uint32),
        ("expected_mesh", POINTER(Mesh)),
        ("allocator", Allocator),
        ("threads", c_uint32),
        ("reserved", c_uint32),
        ("max_vertices", c_uint64),
        ("max_memory", c_uint64),
    ]


class SaveOptions(Structure):
    _fields_ = [("struct_size", c_uint32), ("codec", c_uint32), ("flags", c_uint32), ("reserved", c_uint32)]


class Info(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("metric", c_uint32),
        ("vertex_count", c_uint64),
        ("triangle_count", c_uint64),
        ("welded_vertex_count", c_uint64),
        ("mesh_fingerprint", c_uint64),
        ("table_entries", c_uint64),
        ("border_vertex_count", c_uint64),
        ("bounding_box_diagonal", c_double),
        ("delta", c_double),
        ("seed", c_uint64),
        ("format_major", c_uint32),
        ("format_minor", c_uint32),
        ("level_count", c_uint32),
        ("patch_count", c_uint32 * MAX_LEVELS),
        ("error_sources", c_uint32),
        ("error_mean", c_double),
        ("error_signed_mean", c_double),
        ("error_p99", c_double),
        ("error_p999", c_double),
        ("error_max", c_double),
        ("metric_fingerprint", c_uint64),
        ("metric_flags", c_uint32),
        ("engine", c_uint32),
        ("error_mean_at_vertices", c_double),
        ("codec", c_uint32),
        ("file_flags", c_uint32),
        ("smallest_step", c_double),
        ("largest_step", c_double),
        ("added_vertex_count", c_uint64),
        ("error_near_mean", c_double),
        ("error_near_max", c_double),
        ("error_middle_mean", c_double),
        ("error_middle_max", c_double),
        ("error_far_mean", c_double),
        ("error_far_max", c_double),
        ("error_several_mean", c_double),
        ("error_several_max", c_double),
        ("has_mesh", c_uint32),
        ("reserved", c_uint32),
    ]


class Section(Structure):
    _fields_ = [
        ("tag", c_char * 8),
        ("coding", c_uint32),
        ("reserved", c_uint32),
        ("offset", c_uint64),
        ("stored_size", c_uint64),
        ("raw_size", c_uint64),
    ]


class Issue(Structure):
    _fields_ = [("number", c_uint32), ("status", c_int32), ("offset", c_uint64), ("message", c_char_p)]


IssueFn = CFUNCTYPE(c_int32, c_void_p, POINTER(Issue))


class SurfacePoint(Structure):
    _fields_ = [("triangle", c_uint32), ("reserved", c_uint32), ("weights", c_double * 3)]


class SurfaceOptions(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("weld_tolerance", c_double),
        ("edge_cost_vertices", c_void_p),
        ("edge_costs", c_void_p),
        ("face_costs", c_void_p),
        ("face_cost_count", c_uint64),
        ("edge_cost_count", c_uint32),
        ("points_per_edge", c_uint32),
    ]


class PathPoint(Structure):
    _fields_ = [("point", SurfacePoint), ("position", c_double * 3)]


_HANDLE_OUT = POINTER(c_void_p)

# Arrays and handles are addresses here: void pointers.
FUNCTIONS = {
    "geoidx_version": (c_uint32, []),
    "geoidx_abi_version": (c_uint32, []),
    "geoidx_status_string": (c_char_p, [c_int32]),
    "geoidx_last_error": (c_char_p, []),
    "geoidx_mesh_init_sized": (None, [POINTER(Mesh), c_uint32]),
    "geoidx_build_options_init_sized": (None, [POINTER(BuildOptions), c_uint32]),
    "geoidx_open_options_init_sized": (None, [POINTER(OpenOptions), c_uint32]),
    "geoidx_save_options_init_sized": (None, [POINTER(SaveOptions), c_uint32]),
    "geoidx_build": (c_int32, [POINTER(Mesh), POINTER(BuildOptions), _HANDLE_OUT]),
    "geoidx_save": (c_int32, [c_void_p, c_char_p, POINTER(SaveOptions)]),
    "geoidx_save_memory": (c_int32, [c_void_p, POINTER(SaveOptions), c_void_p, c_uint64, POINTER(c_uint64)]),
    "geoidx_open": (c_int32, [c_char_p, POINTER(OpenOptions), _HANDLE_OUT]),
    "geoidx_open_memory": (c_int32, [c_void_p, c_uint64, POINTER(OpenOptions), _HANDLE_OUT]),
    "geoidx_close": (None, [c_void_p]),
    "geoidx_get_info": (c_int32, [c_void_p, POINTER(Info)]),
    "geoidx_get_sections": (c_int32, [c_void_p, POINTER(Section), c_uint32, POINTER(c_uint32)]),
    "geoidx_verify": (c_int32, [c_void_p, c_uint64, IssueFn, c_void_p]),
    "geoidx_sssd": (c_int32, [c_void_p, c_uint32, c_uint32, POINTER(c_float)]),
    "geoidx_sssd_batch": (c_int32, [c_void_p, c_void_p, c_uint64, c_void_p]),
    "geoidx_msad": (c_int32, [c_void_p, c_void_p, c_uint32, c_void_p, c_uint32]),
    "geoidx_ssad_batch": (c_int32, [c_void_p, c_void_p, c_uint32, c_void_p, c_uint64]),
    "geoidx_matrix": (c_int32, [c_void_p, c_void_p, c_uint32, c_void_p, c_uint32, c_void_p, c_uint64]),
    "geoidx_query_create": (c_int32, [c_void_p, _HANDLE_OUT]),
    "geoidx_query_close": (None, [c_void_p]),
    "geoidx_query_sssd": (c_int32, [c_void_p, c_uint32, c_uint32, POINTER(c_float)]),
    "geoidx_query_msad": (c_int32, [c_void_p, c_void_p, c_uint32, c_void_p, c_uint32]),
    "geoidx_query_ssad_batch": (c_int32, [c_void_p, c_void_p, c_uint32, c_void_p, c_uint64]),
    "geoidx_query_msad_within": (c_int32, [c_void_p, c_void_p, c_uint32, c_float, c_void_p, c_uint32]),
    "geoidx_query_matrix": (c_int32, [c_void_p, c_void_p, c_uint32, c_void_p, c_uint32, c_void_p, c_uint64]),
    "geoidx_query_nearest_sources": (c_int32, [c_void_p, c_void_p, c_uint32, c_void_p, c_void_p, c_uint32]),
    "geoidx_query_within": (
        c_int32,
        [c_void_p, c_void_p, c_uint32, c_float, c_void_p, c_void_p, c_uint32, POINTER(c_uint32)],
    ),
    "geoidx_query_nearest_targets": (
        c_int32,
        [c_void_p, c_uint32, c_void_p, c_uint32, c_void_p, c_void_p, c_uint32, POINTER(c_uint32)],
    ),
    "geoidx_query_farthest_points": (
        c_int32,
        [c_void_p, c_void_p, c_uint32, c_uint32, c_void_p, c_void_p, POINTER(c_uint32)],
    ),
    "geoidx_query_set_threads": (c_int32, [c_void_p, c_uint32]),
    "geoidx_query_prepare": (c_int32, [c_void_p, c_uint32]),
    "geoidx_query_prepared": (c_int32, [c_void_p, c_void_p, c_uint64, c_void_p]),
    "geoidx_surface_options_init_sized": (None, [POINTER(SurfaceOptions), c_uint32]),
    "geoidx_surface_create": (c_int32, [POINTER(Mesh), POINTER(SurfaceOptions), _HANDLE_OUT]),
    "geoidx_surface_close": (None, [c_void_p]),
    "geoidx_surface_of_index": (c_int32, [c_void_p, c_void_p, _HANDLE_OUT]),
    "geoidx_vertex_point": (c_int32, [c_void_p, c_uint32, c_void_p]),
    "geoidx_closest_point": (c_int32, [c_void_p, c_void_p, c_void_p, c_void_p]),
    "geoidx_query_point_sssd": (
        c_int32,
        [c_void_p, c_void_p, c_void_p, c_void_p, c_void_p],
    ),
    "geoidx_query_point_msad": (
        c_int32,
        [c_void_p, c_void_p, c_void_p, c_uint32, c_void_p, c_void_p, c_uint32],
    ),
    "geoidx_query_point_nearest_sources": (
        c_int32,
        [c_void_p, c_void_p, c_void_p, c_uint32, c_void_p, c_void_p, c_void_p, c_uint32],
    ),
    "geoidx_query_point_within": (
        c_int32,
        [c_void_p, c_void_p, c_void_p, c_uint32, c_void_p, c_float, c_void_p, c_void_p, c_uint32, c_void_p],
    ),
    "geoidx_query_point_nearest_targets": (
        c_int32,
        [c_void_p, c_void_p, c_void_p, c_void_p, c_uint32, c_void_p, c_void_p, c_uint32, c_void_p],
    ),
    "geoidx_query_path": (
        c_int32,
        [c_void_p, c_void_p, c_void_p, c_void_p, c_uint32, c_void_p],
    ),
    "geoidx_query_path_points": (c_int32, [c_void_p, c_void_p, c_uint64, POINTER(c_uint64)]),
    "geoidx_query_prepare_target": (c_int32, [c_void_p, c_void_p, c_void_p]),
    "geoidx_query_next_step": (c_int32, [c_void_p, c_void_p, c_void_p, c_void_p, c_void_p]),
    "geoidx_solver_create": (c_int32, [POINTER(Mesh), POINTER(BuildOptions), _HANDLE_OUT]),
    "geoidx_solver_close": (None, [c_void_p]),
    "geoidx_solver_distances": (c_int32, [c_void_p, c_void_p, c_uint32, c_void_p, c_uint32, c_void_p]),
    "geoidx_solver_point_distances": (c_int32, [c_void_p, c_void_p, c_uint32, c_void_p, c_uint32, c_void_p]),
}


def version_text(version: tuple[int, int, int]) -> str:
    return ".".join(str(part) for part in version)


def version_of(library: CDLL) -> tuple[int, int, int]:
    number = library.geoidx_version()
    return number // 10000, number // 100 % 100, number % 100


def _candidates() -> list[str]:
    if named := os.environ.get("GEOIDX_LIBRARY"):
        return [named]
    beside = Path(__file__).with_name("libgeoidx.so")
    by_loader = [f"libgeoidx.so.{ABI_VERSION}", "libgeoidx.so"]
    return [str(beside)] if beside.exists() else by_loader


def _open_library() -> CDLL:
    refusals = []
    for name in _candidates():
        try:
            return CDLL(name)
        except OSError as error:
            refusals.append(str(error))
    raise ImportError("the geoidx library cannot be loaded: " + "; ".join(refusals))


def _declare(library: CDLL, name: str) -> None:
    try:
        function = getattr(library, name)
    except AttributeError as error:
        raise ImportError(f"{library._name} is not a geoidx library: it has no {name}") from error
    function.restype, function.argtypes = FUNCTIONS[name]


def _check_version(library: CDLL) -> None:
    found = version_of(library)
    found_abi = library.geoidx_abi_version()
    if found_abi != ABI_VERSION or found < HEADER_VERSION[:2]:
        raise ImportError(
            f"{library._name} is geoidx {version_text(found)} with ABI {found_abi}, "
            f"but this package needs {version_text(HEADER_VERSION)} or later with ABI {ABI_VERSION}"
        )


def load() -> CDLL:
    """The library of GEOIDX_LIBRARY, else the one beside this file, else the one the system's loader finds."""
    library = _open_library()
    for name in ("geoidx_version", "geoidx_abi_version"):
        _declare(library, name)
    _check_version(library)
    for name in FUNCTIONS:
        _declare(library, name)
    return library


library = load()
