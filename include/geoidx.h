/* geoidx: geodesic distances on triangle meshes, precomputed once, answered from one file.
 *
 * geoidx_build turns a triangle mesh into an index: a hierarchy of patches with precomputed distances
 * (Aiello, Banterle, Pietroni, Malomo, Cignoni, Scopigno, "Compression and Querying of Arbitrary Geodesic
 * Distances", 2015). geoidx_save and geoidx_open move it to and from one file. geoidx_sssd and geoidx_msad
 * answer from it.
 *
 * Conventions that hold for every function here:
 *
 * - Ids. A vertex id is the caller's own: the position of the vertex in the array given to geoidx_build,
 *   whatever welding and clean-up did inside. Valid ids are 0 .. vertex_count - 1.
 * - Distances are in the mesh's own unit. A vertex that cannot be reached is at +INFINITY.
 * - Ownership. The caller owns every array it passes; the library reads or writes it during the call only and
 *   keeps no pointer to it. The library owns handles; each create/build/open has its close. Closing NULL is
 *   fine. Where an output array overlaps an input or another output of the call, all of them hold unspecified
 *   values afterwards, and the call may fail, but nothing outside of them is read or written.
 * - Errors. Functions return a geoidx_status: 0 is success, errors are negative. geoidx_last_error() gives
 * the detail (what, where, which value) of the calling thread's latest failure. On failure an output handle
 * is set to NULL and output arrays hold unspecified values. No exception, abort or print crosses this
 * boundary.
 * - Threads. A `geoidx` and a `geoidx_solver`'s mesh are immutable: any number of threads may query one index
 * at once. A `geoidx_query` and a `geoidx_solver` are one thread's scratch: use each from one thread at a
 * time. Nothing may be in use by another thread while it is closed.
 * - Structs begin with struct_size, set by the matching *_init function or to sizeof(the struct). A shorter
 *   struct from an older caller is accepted; the fields it lacks take their defaults. The functions *_init
 *   live in this header, since only the caller knows how long its struct is; who cannot include it calls
 *   *_init_sized, which fills the first struct_size bytes, at most the whole struct, and nothing if these are
 *   fewer than 4. NULL is fine.
 */
#ifndef GEOIDX_H
#define GEOIDX_H

#include <stdint.h>

#define GEOIDX_VERSION_MAJOR 0
#define GEOIDX_VERSION_MINOR 1
#define GEOIDX_VERSION_PATCH 0

/* Goes up when programs that were compiled with an older header must be compiled again. The shared library's
 * SOVERSION. */
#define GEOIDX_ABI_VERSION 0

#if defined(_WIN32)
#if defined(GEOIDX_BUILDING_SHARED)
#define GEOIDX_API __declspec(dllexport)
#elif defined(GEOIDX_USING_SHARED)
#define GEOIDX_API __declspec(dllimport)
#else
#define GEOIDX_API
#endif
#else
#define GEOIDX_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* An index: immutable, shared by any number of threads. */
typedef struct geoidx geoidx;

/* One thread's scratch for queries on one index. */
typedef struct geoidx_query geoidx_query;

/* A mesh with a metric and one thread's scratch: distances computed from scratch, without an index. */
typedef struct geoidx_solver geoidx_solver;

/* A mesh with its adjacency, for points of the surface: immutable, shared by any number of threads. */
typedef struct geoidx_surface geoidx_surface;

/* 0 is success, errors are negative. The numbers never change once released. */
typedef int32_t geoidx_status;

enum {
    GEOIDX_OK = 0,
    GEOIDX_ERROR_INVALID_ARGUMENT = -1,    /* a NULL where none is allowed, an id or an option out of range */
    GEOIDX_ERROR_IO = -2,                  /* the operating system refused to open, read, write or rename */
    GEOIDX_ERROR_NOT_AN_INDEX = -3,        /* the data does not begin like a geoidx file */
    GEOIDX_ERROR_TRUNCATED = -4,           /* the data is shorter than its header says */
    GEOIDX_ERROR_CORRUPT = -5,             /* the data contradicts the format or itself */
    GEOIDX_ERROR_CHECKSUM = -6,            /* stored bytes do not match their checksum */
    GEOIDX_ERROR_UNSUPPORTED_VERSION = -7, /* written by a newer format, or with features unknown here */
    GEOIDX_ERROR_MESH_MISMATCH = -8,       /* the index belongs to another mesh than the one given */
    /* A count is over what the format or the library can hold, or an index would take memory out of
     * proportion to its file: the overlay engine's tables of borders that hundreds of patches share with the
     * patch around them. */
    GEOIDX_ERROR_LIMIT = -9,
    /* The allocator or the system has no more memory, or the system not even one thread for a build. Nothing
     * leaks, and the handles that the call was given can be used as before. */
    GEOIDX_ERROR_OUT_OF_MEMORY = -10,
    GEOIDX_ERROR_CANCELLED = -11, /* a progress callback returned 0 */
    GEOIDX_ERROR_BAD_MESH = -12,  /* the mesh cannot be used; geoidx_last_error() names the element */
    GEOIDX_ERROR_CALLBACK = -13,  /* the caller's metric failed or returned NaN or a negative number */
    GEOIDX_ERROR_INTERNAL = -14,  /* a defect of this library */
    GEOIDX_ERROR_NO_PATH = -15    /* no path on the surface joins the two points */
};

/* The release of the library: major * 10000 + minor * 100 + patch. */
GEOIDX_API uint32_t geoidx_version(void);

/* GEOIDX_ABI_VERSION of the library, for who finds its functions at run time. */
GEOIDX_API uint32_t geoidx_abi_version(void);

/* A short constant English phrase for a status; never NULL, also for numbers unknown here. */
GEOIDX_API const char* geoidx_status_string(geoidx_status status);

/* The calling thread's latest failure in detail, UTF-8, "" before the first one. Valid until the thread's
 * next call into the library. */
GEOIDX_API const char* geoidx_last_error(void);

/* Memory of the caller's choosing. allocate returns `size` bytes aligned to `alignment` (a power of two, at
 * most 64) or NULL; release gets back exactly what allocate was asked for. Both may be called from several
 * threads at once and must not call into the library. Both NULL (the default) means the global heap. The
 * index, its tables and its query scratch come from here; the temporary memory of building, opening, saving
 * and verifying, a geoidx_solver and what threads need to begin come from the global heap. When either has no
 * more, the call returns GEOIDX_ERROR_OUT_OF_MEMORY. */
typedef struct geoidx_allocator {
    void* (*allocate)(void* user, uint64_t size, uint64_t alignment);
    void (*release)(void* user, void* memory, uint64_t size, uint64_t alignment);
    void* user;
} geoidx_allocator;

enum { GEOIDX_POSITION_FLOAT = 0, GEOIDX_POSITION_DOUBLE = 1 };

/* A triangle mesh, as arrays of the caller's. Vertices with equal positions are one vertex (see
 * weld_tolerance), degenerate and duplicate triangles are dropped, a vertex that no triangle uses keeps its
 * id and is unreachable. Vertices are welded before it is asked which ones a triangle uses: an unused vertex
 * at the place of a used one is reached as that one is, whereas unused vertices that are welded to each
 * other only are unreachable from each other, too. Any number of components, open boundaries, any genus,
 * either orientation, vertices where several fans of triangles meet, and edges with three or more triangles
 * are fine: paths pass from each of them to every other. GEOIDX_ERROR_BAD_MESH: a position that is NaN or
 * infinite, a double larger than the largest float, an id out of range, a mesh without vertices, without
 * triangles or with degenerate ones only, and one whose bounding box has a diagonal that is no normal float
 * (0, smaller than FLT_MIN, or infinite). More vertices or triangles than below, and 2^31 edges or more, are
 * GEOIDX_ERROR_LIMIT. */
typedef struct geoidx_mesh {
    uint32_t struct_size;
    uint32_t position_type;    /* GEOIDX_POSITION_FLOAT (default) or GEOIDX_POSITION_DOUBLE */
    const void* positions;     /* x, y, z of each vertex, `position_stride` bytes apart */
    uint64_t vertex_count;     /* 1 .. 2^32 - 2 */
    const uint32_t* triangles; /* three vertex ids a triangle */
    uint64_t triangle_count;   /* 1 .. 1431655764 */
    uint32_t position_stride;  /* bytes from one vertex to the next; 0: tightly packed */
    uint32_t reserved;         /* not read */
} geoidx_mesh;

GEOIDX_API void geoidx_mesh_init_sized(geoidx_mesh* mesh, uint32_t struct_size);
static inline void geoidx_mesh_init(geoidx_mesh* mesh) { geoidx_mesh_init_sized(mesh, sizeof(geoidx_mesh)); }

enum {
    GEOIDX_METRIC_EXACT = 0,    /* exact polyhedral geodesic distance */
    GEOIDX_METRIC_EDGES = 1,    /* shortest path along edges; edge length, or the caller's cost per edge */
    GEOIDX_METRIC_CALLBACK = 2, /* metric_callback */
    GEOIDX_METRIC_WEIGHTED =
        3 /* a path's length in each triangle times face_costs, approximated from above */
};

/* A flag of a metric: small pieces of the surface can be laid out in the plane with their distances kept, so
 * that a path may be taken to cross an edge anywhere and straight. The exact metric is so, the edge graph is
 * not. */
enum { GEOIDX_METRIC_UNFOLDABLE = 1 };

/* The caller's own metric: writes the distance from `source` to each of `targets` (ids of the caller's mesh)
 * into `distances` and returns GEOIDX_OK; any other value stops the build with GEOIDX_ERROR_CALLBACK.
 * Distances are symmetric, not negative, obey the triangle inequality, and are +INFINITY where there is no
 * path. What is written for `source` itself is taken as 0. Called from several threads at once unless
 * `threads` is 1. */
typedef geoidx_status (*geoidx_metric_fn)(void* user, uint32_t source, const uint32_t* targets,
                                          uint32_t target_count, double* distances);

/* Progress of a build: fraction 0 .. 1, never falling, and a short name of the stage. Return 0 to cancel.
 * Called from the thread that called geoidx_build only, at least a few times a second once the first stages
 * are over, which take some seconds a million vertices. Where vertices may be added (see target_error),
 * stages come again, and the fraction goes from 0.61 to 0.85 at once if none are. */
typedef int32_t (*geoidx_progress_fn)(void* user, float fraction, const char* stage);

/* How an index answers. */
enum {
    /* The paper's way: a search over the tables of every patch's border. Exact within its tables; a path
     * crosses borders at vertices, so that distances are never below the metric's. */
    GEOIDX_ENGINE_GRAPH = 0,
    /* Tables of all borders of a patch's children to each other, 16 bits an entry: a query is a fixed
     * sequence of min-plus products. Where the metric is GEOIDX_METRIC_UNFOLDABLE a path may cross a border
     * between two vertices, the tables are calibrated so that about as many of such paths are too short as
     * are too long, and distances may be a little below the metric's. Building takes time linear in the
     * vertices. With GEOIDX_METRIC_EXACT, delta 0 and no edge_lengths, an index also holds the metric's own
     * distances of those pairs, of each vertex and the 480 nearest ones, of which tables are off by more than
     * a hundredth, at most four for each vertex or 32,768 in all, whichever is more, the most wrong ones
     * first, and none that are too short to have a relative error (see geoidx_info): all queries from
     * vertices answer these, MSAD from several ones source by source. Around such pairs up to 1,920 vertices
     * are compared. With GEOIDX_METRIC_WEIGHTED and delta 0 these are pairs of each vertex and the 120
     * nearest ones, and no more are compared. Pairs of points within triangles have none; in fields from
     * points, those of the vertices around are bounds. On meshes of more than 400,000 vertices fewer are
     * compared. Building takes some 4 KB of memory a vertex for that, up to 8 KB where many pairs are wrong.
     * With GEOIDX_METRIC_EXACT as above, an index also holds the edges along which MSAD would change by more
     * than they are long, and lowers the farther ends of these, measured distances included: from one vertex,
     * the distances of the ends of any edge of the welded mesh differ by no more than 1.05 times its length
     * and the rounding of a float, on meshes of up to 65,536 vertices. On larger ones, from several sources
     * and from points, an edge in a million may be steeper. */
    GEOIDX_ENGINE_OVERLAY = 1
};

enum { GEOIDX_MAX_LEVELS = 8 };

typedef struct geoidx_build_options {
    uint32_t struct_size;
    uint32_t metric;       /* GEOIDX_METRIC_* */
    double weld_tolerance; /* vertices at most this far apart are one; 0 (default): equal positions only */
    double delta;          /* pruning threshold, 0 .. 100 % of the bounding-box diagonal; 0 (default): none */
    uint64_t seed;         /* of every random choice; the same seed gives the same bytes */
    uint32_t threads;      /* 0 (default): one per processor; at most 1024 */
    /* Levels below the whole mesh, at most GEOIDX_MAX_LEVELS; 0 (default): automatic. */
    uint32_t level_count;
    /* patches[0] is n1, the number of patches of level 1; patches[i] how many each patch of level i is split
     * into (patches[1] is n2). A patch is connected, so there can be more. 0 (default): in proportion to the
     * triangles. Numbers beyond level_count are not read, unless that is 0. */
    uint32_t patches[8];
    uint32_t lloyd_iterations; /* relaxations of the seeds (paper 3.1), 0 .. 1000; default 4 */
    /* Costs and lengths are GEOIDX_ERROR_INVALID_ARGUMENT with a metric that does not take them. They are
     * given if their count is not 0, and those of triangles also if their pointer is not NULL.
     * GEOIDX_METRIC_EDGES: the costs of some edges; the others cost their length. */
    uint32_t edge_cost_count;           /* 0 (default): none, the next two are not read */
    const uint32_t* edge_cost_vertices; /* two ids an edge */
    const double* edge_costs;           /* finite and not negative; an edge given twice takes the smaller;
                                           under FLT_MIN, but not 0, is GEOIDX_ERROR_LIMIT */
    geoidx_metric_fn metric_callback;   /* GEOIDX_METRIC_CALLBACK only */
    void* metric_user;
    geoidx_progress_fn progress; /* may be NULL */
    void* progress_user;
    geoidx_allocator allocator;
    uint32_t refuse_edges_of_many; /* 1: an edge with more than two triangles is GEOIDX_ERROR_BAD_MESH; 0
                                      (default): paths pass from each to every other; other values are
                                      GEOIDX_ERROR_INVALID_ARGUMENT */
    uint32_t metric_flags; /* what GEOIDX_METRIC_CALLBACK declares itself to be: GEOIDX_METRIC_UNFOLDABLE or 0
                              (default: symmetric only); not used by other metrics. Unknown flags are
                              GEOIDX_ERROR_INVALID_ARGUMENT, whatever the metric */
    /* GEOIDX_METRIC_WEIGHTED: what a unit of length costs in each triangle of the mesh, positive and finite
     * (along an edge the cheapest triangle there counts, as it does of triangles that are there twice). A
     * cost that takes a side of its triangle under FLT_MIN is GEOIDX_ERROR_LIMIT. Distances are those of a
     * graph with points_per_edge evenly spaced points on every edge, 0 .. 1000, joined straight through every
     * triangle: never below the true ones, and above them by at most the sum, over the pieces that the
     * triangles cut the true path into, of the piece's cost times half of the spacing of points at each of
     * its ends. That is what geoidx_solver_distances gives. By an index, paths cross borders at vertices
     * only, so that vertices in different leaves may be some percent farther apart: see the errors in
     * geoidx_info. */
    const double* face_costs;
    uint64_t face_cost_count; /* the mesh's triangle_count */
    uint32_t points_per_edge; /* default 12: within 0.5 % of Snell's law on a grid of 16 x 16 cells */
    uint32_t engine;          /* GEOIDX_ENGINE_*; default GEOIDX_ENGINE_OVERLAY */
    /* GEOIDX_METRIC_EXACT and _WEIGHTED: a surface given by lengths instead of positions, which then only
     * weld and order vertices: edge_lengths[3 t + k] is the length of the edge opposite to corner k of
     * triangle t, 1.2e-38 to 3.4e38, the same in all triangles at the edge (to 1e-9). A triangle whose
     * sides do not leave it an area is GEOIDX_ERROR_BAD_MESH, and named. */
    const double* edge_lengths; /* NULL (default): none */
    uint64_t edge_length_count; /* 3 times the mesh's triangle_count; 0 (default) without edge_lengths */
    /* GEOIDX_ENGINE_OVERLAY: tables of patches of up to this many vertices hold the metric's own distances,
     * those of larger ones are put together from these; default 400. Larger is more exact, and building
     * takes longer. */
    uint32_t exact_vertices;
    uint32_t reserved; /* not read */
    /* GEOIDX_ENGINE_OVERLAY: distances are rounded to multiples of this share of the way from a vertex to the
     * next, 0 .. 1, for each patch by itself, but never to more than 1/8192 of the longest way on the surface
     * around it, and only to 16 bits in an index of fewer than 65,536 table entries. Default 1/64, which
     * changes an entry by at most 0.8 % of the way to the next vertex. 0: to 16 bits only. Twice the share
     * saves one bit of each table entry in GEOIDX_CODEC_PACKED. The exact metric's distances are measured
     * with a tolerance of 1e-5, as solver_tolerance is one, since they are rounded by more, or as much. */
    double rounding;
    /* GEOIDX_ENGINE_OVERLAY with GEOIDX_METRIC_EXACT, delta 0 and no edge_lengths; not used otherwise: the
     * mean error, 0 .. 1, that the index is to have at most. Scans have less from the start. Where it is
     * larger, as on meshes of large triangles and on rough surfaces, edges between patches are cut in halves
     * and the tables are made anew, up to five times, as long as the error becomes smaller by a twentieth and
     * table entries stay below two and a half times their number without, or 131,072; so the error may also
     * stay larger. What is cut there are *added vertices*: they have no id and are in no answer. Where
     * triangles with edges that are long for the surface are a sixteenth of its area, fields from points
     * within them are to have that mean error, too, and a p99.9 of at most twenty times as much, which the
     * index does not state. Default 0.0005, which is 0.05 %. 0: none. */
    double target_error;
    /* 1: the index keeps the mesh, bit for bit, so that its file alone is enough for points of the surface
     * and for paths: see geoidx_surface_of_index. It takes some 20 bytes a vertex of a closed mesh with
     * positions in single precision, 30 in double. 0 (default): it does not. */
    uint32_t store_mesh;
    uint32_t reserved_at_end; /* not read */
    /* geoidx_solver_create with GEOIDX_METRIC_EXACT; not used otherwise: distances may be off by about this
     * share of themselves, 0 .. 1e-4, so that a whole field takes less time: at 1e-5 scans take 0.6 to 0.9 of
     * it, surfaces of long triangles a half to a tenth. On 563 meshes, fields were off by at most one and a
     * half times that share on average (at 3e-5 and above, six times), and by at most a hundred times it
     * anywhere, too long or too short. Where edges are shorter than a hundred times the share of the
     * distance, nothing is saved. Targets are final within the tolerance. 0 (default): exact. */
    double solver_tolerance;
} geoidx_build_options;

GEOIDX_API void geoidx_build_options_init_sized(geoidx_build_options* options, uint32_t struct_size);
static inline void geoidx_build_options_init(geoidx_build_options* options) {
    geoidx_build_options_init_sized(options, sizeof(geoidx_build_options));
}

/* Flags of geoidx_open_options. GEOIDX_OPEN_PAIRS makes an index ready for pairs of vertices while it is
 * opened: about 0.1 s for 40,000 vertices. Without it, the first call that asks for a pair (geoidx_sssd,
 * geoidx_query_sssd and the like) makes a part of what pairs need, in up to a third of that time, and takes
 * the memory for all of it, about as much as the rest of the index; each later one makes what is missing
 * around its vertices, which takes 1 to 15 ms and half as much memory again meanwhile, once for all threads,
 * some thirty times for 40,000 vertices. An index of which only fields are asked never takes either. It is
 * the same for an index that was just built. The answers are the same bits. Nothing is made for
 * GEOIDX_ENGINE_GRAPH. */
enum {
    GEOIDX_OPEN_PAIRS = 1,
    /* geoidx_open_memory only: `data` stays as it is until geoidx_close, so that the tables of a file of
     * GEOIDX_CODEC_MAPPED need not be copied. It must be aligned to 8 bytes, better to 64. */
    GEOIDX_OPEN_BORROW = 2,
    /* What pairs need is made without labels, the distances of each vertex to one or two borders that lie
     * farther out. Pairs then take a tenth of the time to be made ready for, and a third of the memory, and
     * each takes two to five times as long. Answers differ from those with labels by 0.01 % on average, and
     * by 1 to 3 % at most, on rough terrain by up to 5 %. An index that was just built has labels. */
    GEOIDX_OPEN_NO_LABELS = 4
};

typedef struct geoidx_open_options {
    uint32_t struct_size;
    uint32_t flags; /* GEOIDX_OPEN_*, added up; other bits are GEOIDX_ERROR_INVALID_ARGUMENT */
    /* May be NULL; otherwise the index must have been built from this very mesh, else
     * GEOIDX_ERROR_MESH_MISMATCH: the same triangles in the same order, and positions that are equal as
     * floats, so that it does not matter which of the two was given in double precision. (Two meshes that
     * differ by less than a float can tell, which may be much far from the origin, count as one.) A file of
     * GEOIDX_SAVE_NO_POSITIONS needs it: NULL is GEOIDX_ERROR_INVALID_ARGUMENT then, and positions that are
     * equal as floats only may be GEOIDX_ERROR_MESH_MISMATCH. Those that the index was built from, in the
     * same precision, are always right. */
    const geoidx_mesh* expected_mesh;
    geoidx_allocator allocator;
    uint32_t threads;  /* that decode tables; 0 (default): one per processor; at most 1024 */
    uint32_t reserved; /* not read */
    /* What a file may ask for; more is GEOIDX_ERROR_LIMIT. max_vertices: how long the caller's vertex array
     * may have been; 0 (default): any. max_memory: bytes that the decoded sections of the file, and that the
     * index with its queries may take, each; 0 (default): in proportion to the file, see geoidx_open. The
     * latter holds as long as the index is open, so that a query, too, may be refused. */
    uint64_t max_vertices;
    uint64_t max_memory;
} geoidx_open_options;

GEOIDX_API void geoidx_open_options_init_sized(geoidx_open_options* options, uint32_t struct_size);
static inline void geoidx_open_options_init(geoidx_open_options* options) {
    geoidx_open_options_init_sized(options, sizeof(geoidx_open_options));
}

/* The forms that a file keeps distances in. All hold the same distances, so that answers are the same bits.
 * GEOIDX_CODEC_PACKED (default): what is left of them when they are predicted from the positions of their
 * vertices and from each other, as gray PNG images. GEOIDX_CODEC_LOSSLESS: a PNG of float32 for each table,
 * as the paper has it; what indices of GEOIDX_ENGINE_GRAPH are always saved as. GEOIDX_CODEC_MAPPED: the
 * tables as queries read them, uncompressed: ten times as large as packed or more on large meshes, but
 * nothing is left to do when it is opened. geoidx_open maps such a file instead of reading it, so that
 * processes share one copy in memory; as long as an index is open, nobody may write into the file or cut it
 * short (geoidx_save replaces a file, which is no harm except on Windows, where it fails). */
enum { GEOIDX_CODEC_PACKED = 0, GEOIDX_CODEC_LOSSLESS = 1, GEOIDX_CODEC_MAPPED = 2 };

/* Flags of geoidx_save_options. GEOIDX_SAVE_NO_POSITIONS leaves the positions of vertices out of the file,
 * some 3.5 bytes a vertex, for whoever has the mesh at hand whenever the file is opened: it opens only with
 * geoidx_open_options.expected_mesh, whose positions it takes, also where the file keeps the mesh. The
 * answers are the same bits, and the index can be saved with positions again. GEOIDX_SAVE_NO_MESH leaves out
 * the mesh of an index that keeps it (geoidx_build_options.store_mesh). */
enum { GEOIDX_SAVE_NO_POSITIONS = 1, GEOIDX_SAVE_NO_MESH = 2 };

typedef struct geoidx_save_options {
    uint32_t struct_size;
    uint32_t codec;    /* GEOIDX_CODEC_*; others are GEOIDX_ERROR_INVALID_ARGUMENT */
    uint32_t flags;    /* GEOIDX_SAVE_*, added up; other bits are GEOIDX_ERROR_INVALID_ARGUMENT */
    uint32_t reserved; /* not read */
} geoidx_save_options;

GEOIDX_API void geoidx_save_options_init_sized(geoidx_save_options* options, uint32_t struct_size);
static inline void geoidx_save_options_init(geoidx_save_options* options) {
    geoidx_save_options_init_sized(options, sizeof(geoidx_save_options));
}

/* What an index is. Errors are of distances against the metric itself, |d - exact| / exact, measured when the
 * index was built. But for the largest ones and those of several sources, they are of MSAD over all targets
 * of `error_sources` seeded random sources. Largest ones are never below what was found, and mostly above:
 * what is expected of all pairs, by how far apart the ten largest lie that were found in different places. */
typedef struct geoidx_info {
    uint32_t struct_size;
    uint32_t metric;              /* GEOIDX_METRIC_* */
    uint64_t vertex_count;        /* of the caller's array */
    uint64_t triangle_count;      /* of the caller's array */
    uint64_t welded_vertex_count; /* distinct vertices after welding that a triangle uses */
    uint64_t mesh_fingerprint;    /* of triangles and positions, the latter as floats (see expected_mesh) */
    uint64_t table_entries;       /* distances in all tables; of a symmetric one below the diagonal, but for
                                     border tables */
    uint64_t border_vertex_count; /* vertices on a border of the last level after pruning, with added ones */
    double bounding_box_diagonal;
    double delta;
    uint64_t seed;
    uint32_t format_major; /* of the file that it was opened from; of one that was built, what is saved */
    uint32_t format_minor;
    uint32_t level_count;
    uint32_t patch_count[8]; /* of levels 1 .. level_count */
    /* Errors are relative to the metric's distance. Of distances that are too short to be told from 0 by a
     * float, none are stated and none count in target_error: those up to 2^-23 (1.2e-7) of the diagonal of
     * the box around what edges join or, where costs, lengths or a callback decide distances, of the longest
     * distance there from the random sources; and those that are no normal float. So two vertices that
     * rounding has put 1e-16 apart, as at a pole, say nothing. */
    uint32_t error_sources;
    double error_mean;
    double error_signed_mean;
    double error_p99;
    double error_p999;
    double error_max; /* the largest of one source, MSAD or SSSD, near, middle or far: see below */
    uint64_t
        metric_fingerprint; /* of what decides the metric besides the mesh (costs, lengths); 0: nothing */
    uint32_t metric_flags;  /* GEOIDX_METRIC_UNFOLDABLE */
    uint32_t engine;        /* GEOIDX_ENGINE_* */
    /* The mean error if paths crossed borders at vertices only: what unfolding is worth on this mesh;
     * error_mean where they do. */
    double error_mean_at_vertices;
    uint32_t codec;      /* GEOIDX_CODEC_* of the file that it was opened from; of one that was built, what
                            geoidx_save takes by default */
    uint32_t file_flags; /* GEOIDX_SAVE_NO_POSITIONS if the file that it was opened from has none, or 0 */
    /* GEOIDX_ENGINE_OVERLAY: what the distances of a table are multiples of, for the table with the smallest
     * and with the largest steps; half of it is the most that rounding changes an entry by, except that
     * different vertices are no less than a step apart. 0 for GEOIDX_ENGINE_GRAPH, whose distances are
     * floats. */
    double smallest_step;
    double largest_step;
    uint64_t added_vertex_count; /* vertices of the tables that have no id, see target_error */
    /* Errors of one source by the exact distance: near is up to 10 average edges, middle up to 100, far
     * beyond. Where positions alone decide distances, edges are averaged over the mesh; where costs, lengths
     * or a callback do, over those at the random sources, each as long as the metric says. Means are of MSAD
     * from the random sources. Maxima are also of a search for large errors, of MSAD and of SSSD: on and next
     * to the borders of patches, where both directions of a pair differ in MSAD or SSSD does from these, and
     * around the worst pairs found so far. They are what is expected of the largest errors of all pairs, not
     * less than what was found. It is no proof: another pair may be worse, about one in a million. The search
     * is shorter on meshes of fewer than 2,000 vertices, and with
     * GEOIDX_ENGINE_GRAPH (MSAD only, since SSSD is no worse there), GEOIDX_METRIC_WEIGHTED and
     * GEOIDX_METRIC_CALLBACK, which take longer to ask; a callback is asked for at most 40 fields more. 0
     * where the mesh has no such distances. */
    double error_near_mean;
    double error_near_max;
    double error_middle_mean;
    double error_middle_max;
    double error_far_mean;
    double error_far_max;
    /* Of MSAD from 2, 16 and 64 sources, fewer on small meshes, which lie anywhere, around one vertex, or
     * next to each other along a border; over all targets. With GEOIDX_METRIC_CALLBACK, from some of the
     * random sources. The maximum is no less than that of MSAD from one source, since the least of several
     * distances is off by no more than they are. 0 where they reach nothing else. */
    double error_several_mean;
    double error_several_max;
    uint32_t has_mesh; /* 1 if the index keeps the mesh, see geoidx_surface_of_index */
    uint32_t reserved; /* 0 */
} geoidx_info;

/* A section of the file that an index was opened from; format/SPEC.md says what is in it. */
typedef struct geoidx_section {
    char tag[8];          /* four characters and zeros */
    uint32_t coding;      /* 0 raw, 1 zstd, 2 a PNG a matrix, 3 gray PNG images */
    uint32_t reserved;    /* 0 */
    uint64_t offset;      /* bytes from the start of the file */
    uint64_t stored_size; /* bytes in the file */
    uint64_t raw_size;    /* bytes when decoded */
} geoidx_section;

/* ---- Building, saving, opening
 * ------------------------------------------------------------------------------ */

/* Builds the index of a mesh (paper section 3). `options` may be NULL for the defaults. *out is the new
 * index, to be closed with geoidx_close. Deterministic: mesh, options and seed decide every bit, whatever the
 * threads. */
GEOIDX_API geoidx_status geoidx_build(const geoidx_mesh* mesh, const geoidx_build_options* options,
                                      geoidx** out);

/* Writes the index to a file, replacing what is there: a sibling file is written, synced and renamed, so that
 * a failure leaves neither a partial file nor a damaged old one. `options` may be NULL: the file then has the
 * codec and the flags that geoidx_info names. GEOIDX_ERROR_CORRUPT if the index came from a mapped file whose
 * tables contradict each other, or are not rounded as other codecs have it, and another codec is asked for.
 */
GEOIDX_API geoidx_status geoidx_save(const geoidx* index, const char* utf8_path,
                                     const geoidx_save_options* options);

/* The same bytes into the caller's buffer. *needed is set to their number, or to 0 where the call fails
 * before it is known; when capacity is smaller, nothing is written and GEOIDX_ERROR_INVALID_ARGUMENT is
 * returned, unless buffer is NULL and capacity 0, which asks for the size and succeeds. Each call makes the
 * bytes anew, also one that only asks for their number: a buffer that is likely to be large enough saves half
 * of the time. */
GEOIDX_API geoidx_status geoidx_save_memory(const geoidx* index, const geoidx_save_options* options,
                                            void* buffer, uint64_t capacity, uint64_t* needed);

/* Opens an index. Everything in the file is checked before it is believed, but for whether the tables of a
 * mapped file agree with each other and are rounded as in other files, which geoidx_verify looks at, and
 * geoidx_save with another codec: where they do not agree, distances are wrong, and nothing worse. A mesh
 * that the file keeps stays packed: what it holds is checked by geoidx_surface_of_index and by geoidx_verify.
 * The index, its queries and the temporary memory of opening take at most 256 times the raw size of the
 * file's sections, table entries counted as 4 bytes, and 32 MiB; what would take more is GEOIDX_ERROR_LIMIT
 * before memory is taken. A small file can hold raw sections 1032 times its size. `options` may be NULL. */
GEOIDX_API geoidx_status geoidx_open(const char* utf8_path, const geoidx_open_options* options, geoidx** out);

/* The same from memory; `data` is not needed after the call, unless GEOIDX_OPEN_BORROW is given. */
GEOIDX_API geoidx_status geoidx_open_memory(const void* data, uint64_t size,
                                            const geoidx_open_options* options, geoidx** out);

GEOIDX_API void geoidx_close(geoidx* index);

/* Fills *info, as many bytes of it as its struct_size says and this library knows, and sets struct_size to
 * their number. Fields behind these stay as they are: a struct of a later header has some that this library
 * does not know. */
GEOIDX_API geoidx_status geoidx_get_info(const geoidx* index, geoidx_info* info);

/* The sections of the file that the index was opened from, in the order of the file; an index that was built
 * has none. *count is set to their number, or to 0 where the call fails; up to `capacity` of them are written
 * to `sections`, which may be NULL if capacity is 0. */
GEOIDX_API geoidx_status geoidx_get_sections(const geoidx* index, geoidx_section* sections, uint32_t capacity,
                                             uint32_t* count);

/* What is wrong with a file: the number of the rule that it breaks. format/SPEC.md, "What a reader must
 * refuse", has the rules. Once released, a number never changes and is never used for another rule; later
 * versions may add numbers. */
enum {
    /* The container: header, section table, padding and checksums. */
    GEOIDX_ISSUE_MAGIC = 1,             /* the data does not begin like a geoidx file */
    GEOIDX_ISSUE_HEADER_TRUNCATED = 2,  /* the data ends within the header */
    GEOIDX_ISSUE_VERSION = 3,           /* another major version of the format */
    GEOIDX_ISSUE_FEATURE_FLAGS = 4,     /* an incompatible feature flag that is unknown here */
    GEOIDX_ISSUE_FILE_TRUNCATED = 5,    /* shorter than the file size in the header */
    GEOIDX_ISSUE_FILE_TOO_LONG = 6,     /* longer than the file size in the header */
    GEOIDX_ISSUE_SECTION_COUNT = 7,     /* more sections than the format allows */
    GEOIDX_ISSUE_SECTION_TABLE = 8,     /* the section table does not fit into the file */
    GEOIDX_ISSUE_SECTION_OUTSIDE = 9,   /* a section is not inside the file */
    GEOIDX_ISSUE_SECTION_PLACE = 10,    /* a section does not stand right behind the one before it */
    GEOIDX_ISSUE_SECTION_TWICE = 11,    /* two sections have one tag */
    GEOIDX_ISSUE_SECTION_FLAGS = 12,    /* an undefined flag of a section, or its reserved field is not 0 */
    GEOIDX_ISSUE_SECTION_UNKNOWN = 13,  /* a section that is needed and unknown here */
    GEOIDX_ISSUE_SECTION_CODEC = 14,    /* a section with a codec that is unknown here */
    GEOIDX_ISSUE_SECTION_SIZE = 15,     /* a raw size that the stored bytes of a section cannot hold */
    GEOIDX_ISSUE_FILE_END = 16,         /* the file does not end with the last section */
    GEOIDX_ISSUE_HEADER_CHECKSUM = 17,  /* the checksum of header and section table does not match */
    GEOIDX_ISSUE_PADDING = 18,          /* a byte between sections is not 0 */
    GEOIDX_ISSUE_SECTION_CHECKSUM = 19, /* the checksum of a section does not match */

    /* The stored bytes of a section are not what its codec makes. */
    GEOIDX_ISSUE_DECODING = 100,
    /* The content of one section, by its tag: it is missing, has the wrong size or form, or contradicts the
     * format or the sections before it. */
    GEOIDX_ISSUE_META = 101,
    GEOIDX_ISSUE_HIER = 102,
    GEOIDX_ISSUE_VERT = 103,
    GEOIDX_ISSUE_POSI = 104,
    GEOIDX_ISSUE_BORD = 105,
    GEOIDX_ISSUE_BVBV = 106,
    GEOIDX_ISSUE_BVIV = 107,
    GEOIDX_ISSUE_IVIV = 108,
    GEOIDX_ISSUE_QUAN = 109,
    GEOIDX_ISSUE_SEGM = 110,
    GEOIDX_ISSUE_OVOV = 111,
    GEOIDX_ISSUE_HOPS = 112,
    GEOIDX_ISSUE_MESH = 113,
    GEOIDX_ISSUE_PAIR = 114,
    GEOIDX_ISSUE_EDGE = 115,

    /* No single section is at fault: the index as a whole is over a limit, takes memory out of proportion to
     * its file, or cannot be read on this machine. */
    GEOIDX_ISSUE_WHOLE_INDEX = 200
};

/* A problem of a file. The library makes these; later versions may add fields at the end. */
typedef struct geoidx_issue {
    uint32_t number; /* GEOIDX_ISSUE_*, or of a later version */
    geoidx_status status;
    /* Where the problem is, in bytes from the start of the data. The container's problems are at the field,
     * the record of the section table or the stored byte that is wrong, or at the end of data that is too
     * short. Those of 100 .. 199 are at the first stored byte of their section, or at 0 if it is missing;
     * those of 200 and more are at 0. */
    uint64_t offset;
    const char* message; /* one line of UTF-8 */
} geoidx_issue;

/* Told once for each problem found, which is valid during the call. Return 0 to stop. */
typedef int32_t (*geoidx_issue_fn)(void* user, const geoidx_issue* issue);

/* Checks an index in memory as geoidx_open_memory does, and accepts what that accepts, but goes on after a
 * problem where it can: all problems of the container are told, and if there are none, the first one of what
 * the sections hold, the mesh included, which opening does not unpack. Of a file without positions it needs
 * no mesh, and checks all that does not depend on them: not whether they belong to the mesh, and of the
 * tables of GEOIDX_CODEC_PACKED their sizes, but not every entry, so that geoidx_open may still refuse one.
 * Data that does not begin at a multiple of 8 is copied first. Returns GEOIDX_OK when there is no problem,
 * otherwise the first one's status. `issue` may be NULL. */
GEOIDX_API geoidx_status geoidx_verify(const void* data, uint64_t size, geoidx_issue_fn issue, void* user);

/* ---- Points of the surface
 * ------------------------------------------------------------------------------ */

/* A point of the surface: of triangle `triangle` of the caller's array, which must not be degenerate, with
 * the weights of its three corners: not negative, 1 in sum (to 1e-6; they are scaled to it). Weights of 0 put
 * it on an edge, a weight of 1 at a corner; weights under 1e-12 count as 0. */
typedef struct geoidx_surface_point {
    uint32_t triangle;
    uint32_t reserved; /* not read */
    double weights[3];
} geoidx_surface_point;

/* The options of the index that a surface is used with. An index does not keep the costs that it was built
 * with: paths by these need the same arrays here as in geoidx_build_options. A surface can have costs of
 * edges and of faces at once, for several indices; an index that was built without costs ignores them. */
typedef struct geoidx_surface_options {
    uint32_t struct_size;
    uint32_t reserved;                  /* not read */
    double weld_tolerance;              /* that the index was built with; default 0 */
    const uint32_t* edge_cost_vertices; /* two ids an edge */
    const double* edge_costs;
    const double* face_costs;
    uint64_t face_cost_count; /* the mesh's triangle_count; 0 (default): none, face_costs is not read */
    uint32_t edge_cost_count; /* 0 (default): none, its arrays are not read */
    uint32_t points_per_edge; /* that the index of face_costs was built with; default 12 */
} geoidx_surface_options;

GEOIDX_API void geoidx_surface_options_init_sized(geoidx_surface_options* options, uint32_t struct_size);
static inline void geoidx_surface_options_init(geoidx_surface_options* options) {
    geoidx_surface_options_init_sized(options, sizeof(geoidx_surface_options));
}

/* Makes a surface of the caller's mesh, by the rules of geoidx_mesh; `options` may be NULL. It takes some 93
 * bytes a vertex of a closed mesh, and some 60 for each triangle of planes that are cut into slivers, from
 * the global heap, and no more for any number of threads. A query takes a surface of the mesh that its index
 * was built from; GEOIDX_ERROR_MESH_MISMATCH for another one, GEOIDX_ERROR_INVALID_ARGUMENT for one that is
 * welded to more or fewer vertices. To be closed with geoidx_surface_close. */
GEOIDX_API geoidx_status geoidx_surface_create(const geoidx_mesh* mesh, const geoidx_surface_options* options,
                                               geoidx_surface** out);
GEOIDX_API void geoidx_surface_close(geoidx_surface* surface);

/* The same of the mesh that an index keeps (geoidx_build_options.store_mesh, geoidx_info.has_mesh), with the
 * vertices welded as they were when the index was built: it is the surface that geoidx_surface_create makes
 * of the caller's mesh, with the same ids, triangles and bits of every answer, and it outlives the index. An
 * index that keeps no mesh is GEOIDX_ERROR_INVALID_ARGUMENT. GEOIDX_ERROR_CORRUPT if the mesh in the file is
 * not the one that the index was built from. Of `options`, which may be NULL, the costs count; weld_tolerance
 * is not read. It takes as long as geoidx_surface_create, and as much memory from the global heap, which
 * max_memory of geoidx_open_options does not count. */
GEOIDX_API geoidx_status geoidx_surface_of_index(const geoidx* index, const geoidx_surface_options* options,
                                                 geoidx_surface** out);

/* A vertex as a point of the surface: a corner of the first of the caller's triangles that are not degenerate
 * and have it, or one that it is welded to. GEOIDX_ERROR_INVALID_ARGUMENT for an id out of range, and for a
 * vertex that no such triangle has. */
GEOIDX_API geoidx_status geoidx_vertex_point(const geoidx_surface* surface, uint32_t vertex,
                                             geoidx_surface_point* point);

/* The point of the surface that is nearest to a position in space, three finite numbers; of several that are
 * as near, one of them. Its triangle is one of the caller's that is not degenerate, of duplicate ones the
 * first. `distance`, the straight one in space, may be NULL. */
GEOIDX_API geoidx_status geoidx_closest_point(const geoidx_surface* surface, const double* position,
                                              geoidx_surface_point* point, double* distance);

/* ---- Queries (paper section 3.4)
 * ----------------------------------------------------------------------------- */

/* Single source, single destination. Symmetric bit for bit; 0 for a vertex and itself. Two vertices of one
 * leaf, not both of them on its border, are as far apart as the metric says: to float precision by
 * GEOIDX_ENGINE_GRAPH, whose distances are never below the metric by more than that; by GEOIDX_ENGINE_OVERLAY
 * to half a step of the leaf's table, or to one step where they are nearer than a step, and with
 * GEOIDX_METRIC_EXACT to the tolerance that tables are measured with (see `rounding`). No step is longer than
 * geoidx_info.largest_step. */
GEOIDX_API geoidx_status geoidx_sssd(const geoidx* index, uint32_t source, uint32_t target, float* distance);

/* pair_count pairs: source_target_pairs[2 i] and [2 i + 1] give distances[i], the same bits as geoidx_sssd.
 * Many pairs at once take less time each: those that begin near each other are answered one after the
 * other. When a vertex is out of range, nothing is written. */
GEOIDX_API geoidx_status geoidx_sssd_batch(const geoidx* index, const uint32_t* source_target_pairs,
                                           uint64_t pair_count, float* distances);

/* Multiple sources, all destinations: distances[v] is the distance from v to the nearest of 1 or more
 * sources. distance_count must be the mesh's vertex_count. Neither the order of the sources nor repetitions
 * change a bit. */
GEOIDX_API geoidx_status geoidx_msad(const geoidx* index, const uint32_t* sources, uint32_t source_count,
                                     float* distances, uint32_t distance_count);

/* The distances of each source by itself, to every vertex: distances[i * vertex_count + v] is that from
 * sources[i] to v, the same bits as geoidx_msad gives with this source alone. distance_count must be
 * source_count times the mesh's vertex_count; both may be 0. By GEOIDX_ENGINE_OVERLAY 16 sources go through
 * the tables at a time (scratch: 64 bytes a vertex). */
GEOIDX_API geoidx_status geoidx_ssad_batch(const geoidx* index, const uint32_t* sources,
                                           uint32_t source_count, float* distances, uint64_t distance_count);

/* The distance from every source to every target: distances[i * target_count + j] is that from sources[i] to
 * targets[j]. distance_count must be source_count times target_count. Each is as geoidx_sssd gives it, or as
 * geoidx_ssad_batch gives it from the source or from the target, whichever takes least time for all of them.
 * Answers of these kinds differ by the error of the index; of fields, a matrix of vertices to themselves is
 * symmetric to that error only. When a vertex is out of range, nothing is written. */
GEOIDX_API geoidx_status geoidx_matrix(const geoidx* index, const uint32_t* sources, uint32_t source_count,
                                       const uint32_t* targets, uint32_t target_count, float* distances,
                                       uint64_t distance_count);

/* One thread's scratch, so that a query does not lock and, after the first ones, does not allocate, but for
 * paths and what says so below. The index must outlive it. */
GEOIDX_API geoidx_status geoidx_query_create(const geoidx* index, geoidx_query** out);
GEOIDX_API void geoidx_query_close(geoidx_query* query);
GEOIDX_API geoidx_status geoidx_query_sssd(geoidx_query* query, uint32_t source, uint32_t target,
                                           float* distance);
GEOIDX_API geoidx_status geoidx_query_msad(geoidx_query* query, const uint32_t* sources,
                                           uint32_t source_count, float* distances, uint32_t distance_count);

GEOIDX_API geoidx_status geoidx_query_ssad_batch(geoidx_query* query, const uint32_t* sources,
                                                 uint32_t source_count, float* distances,
                                                 uint64_t distance_count);

/* geoidx_query_msad, but vertices farther than `radius` (0 or more) are at +INFINITY. GEOIDX_ENGINE_OVERLAY
 * does not look into patches that are farther. */
GEOIDX_API geoidx_status geoidx_query_msad_within(geoidx_query* query, const uint32_t* sources,
                                                  uint32_t source_count, float radius, float* distances,
                                                  uint32_t distance_count);

GEOIDX_API geoidx_status geoidx_query_matrix(geoidx_query* query, const uint32_t* sources,
                                             uint32_t source_count, const uint32_t* targets,
                                             uint32_t target_count, float* distances,
                                             uint64_t distance_count);

/* The nearest source to each vertex: nearest[v] is its position in `sources`, and GEOIDX_NO_SOURCE where no
 * source is reached. A source that is nearer than every other one by more than the error of the index is the
 * one that is found. Of several that are as near, it is one whose choice depends on the index and on the set
 * of sources, not on their order; of a vertex that is repeated or welded, the first. vertex_count must be the
 * mesh's. distances[v] are the same bits as those of geoidx_query_msad; `distances` may be NULL. */
#define GEOIDX_NO_SOURCE 0xffffffffu
GEOIDX_API geoidx_status geoidx_query_nearest_sources(geoidx_query* query, const uint32_t* sources,
                                                      uint32_t source_count, uint32_t* nearest,
                                                      float* distances, uint32_t vertex_count);

/* The vertices that can be reached and are no farther than `radius` (0 or more) from the nearest of 1 or more
 * sources, the nearest first, of those that are as near the one with the least id. *count is set to how many
 * there are; vertices[i] and distances[i] are written for as many of them as `capacity`, which both arrays
 * have room for. distances may be NULL, and so may both if capacity is 0. From one source the distances are
 * the same bits as those of geoidx_query_msad_within; from several they are the least of those from each,
 * with the measured pairs of each.
 * GEOIDX_ENGINE_OVERLAY looks only into patches within the radius of each source, and takes time in
 * proportion to that; its scratch is 4 bytes a vertex, 4 to 8 more for the ids, and some 20 for each vertex
 * that is found, up to 60 from several sources. */
GEOIDX_API geoidx_status geoidx_query_within(geoidx_query* query, const uint32_t* sources,
                                             uint32_t source_count, float radius, uint32_t* vertices,
                                             float* distances, uint32_t capacity, uint32_t* count);

/* The nearest of some targets: positions[i] are positions in `targets`, the nearest first; targets that are
 * as near come in the order of `targets`. *count is set to how many are written: `capacity`, which
 * `positions` and `distances` have room for, unless fewer targets can be reached. distances may be NULL. Few
 * targets are asked for one by one, as by geoidx_query_sssd; with many GEOIDX_ENGINE_OVERLAY looks only into
 * patches that are little farther than the targets that it finds, as geoidx_query_within does. The distances
 * of these two kinds differ by the error of the index. */
GEOIDX_API geoidx_status geoidx_query_nearest_targets(geoidx_query* query, uint32_t source,
                                                      const uint32_t* targets, uint32_t target_count,
                                                      uint32_t* positions, float* distances,
                                                      uint32_t capacity, uint32_t* count);

/* Farthest-point sampling: points[i] is the vertex that is farthest from the nearest of the 1 or more sources
 * and of the points before it, and distances[i] how far it is; of several that are as far, one whose choice
 * depends on the index alone. Vertices that cannot be reached are infinitely far, so that each component has
 * a point before any has two. Vertices that no triangle uses are never chosen, nor are two at distance 0 of
 * each other, as those at one place are, and those that edges without cost join. *count is set to how many
 * were found: point_count, unless all other vertices of triangles are at distance 0 of these. `points`
 * and `distances` have room for point_count; distances may be NULL. Each point after the first ones looks
 * only at what lies nearer to it than the farthest vertex. 4 bytes of the index's memory a vertex are taken
 * during the call, and 4 to 8 for the ids are kept. */
GEOIDX_API geoidx_status geoidx_query_farthest_points(geoidx_query* query, const uint32_t* sources,
                                                      uint32_t source_count, uint32_t point_count,
                                                      uint32_t* points, float* distances, uint32_t* count);

/* From then on geoidx_query_msad, geoidx_query_msad_within, geoidx_query_point_msad,
 * geoidx_query_nearest_sources, geoidx_query_point_nearest_sources and geoidx_query_farthest_points of this
 * query use so many threads, which begin and end within each call, for the same bits, or as many of them as
 * the system can begin: 1 at first, 0 means one per processor, at most 1024. GEOIDX_ENGINE_GRAPH uses one. */
GEOIDX_API geoidx_status geoidx_query_set_threads(geoidx_query* query, uint32_t threads);

/* Keeps what depends on the source, for geoidx_query_prepared, until the next call of this function for the
 * query. One with an id out of range changes nothing, any other that fails leaves no source prepared.
 * GEOIDX_ENGINE_OVERLAY: 4 bytes of scratch a vertex, and some 15 more where targets in all parts of the mesh
 * are asked for. What is kept is made as targets need it, so that the first target in a part of the mesh
 * takes longer than others there; for targets in all parts that comes to about half the time of MSAD. Near
 * pairs of vertices may take as much scratch of the same kind. */
GEOIDX_API geoidx_status geoidx_query_prepare(geoidx_query* query, uint32_t source);

/* distances[i]: from the prepared source to targets[i]; GEOIDX_ERROR_INVALID_ARGUMENT without one. By
 * GEOIDX_ENGINE_OVERLAY they differ a little from those of MSAD (about 0.008 % on average) and of geoidx_sssd
 * (0.01 %). */
GEOIDX_API geoidx_status geoidx_query_prepared(geoidx_query* query, const uint32_t* targets,
                                               uint64_t target_count, float* distances);

/* The functions below take points of the surface. Those of distances, geoidx_query_point_*, serve indices of
 * GEOIDX_METRIC_EXACT without edge_lengths and of GEOIDX_METRIC_EDGES without edge costs; with another metric
 * they are GEOIDX_ERROR_INVALID_ARGUMENT. By GEOIDX_METRIC_EDGES a way leads from a point straight to the
 * corners of the triangle that it is given on, and along edges from there. By GEOIDX_METRIC_EXACT distances
 * come from those of up to 128 vertices around the point, by GEOIDX_ENGINE_GRAPH of the three corners,
 * unfolded over the triangles between: to the accuracy of the index, but where these are reached from
 * different sides, as around holes that are as small as triangles or between spikes, off by a share of the
 * triangles' edges. `surface` must be of the index's mesh, and stay open during the call only. */

/* geoidx_query_sssd between points of the surface, symmetric bit for bit. Of points at vertices it gives the
 * same bits. By GEOIDX_METRIC_EXACT, points of one triangle that are not both vertices are as far apart as
 * the straight line between them is long, and so are those of triangles that share an edge which that line
 * crosses, unless the index knows a much shorter way; so are those a few triangles apart that see each other
 * over these, unless the index knows a way that is shorter by a hundredth. Where the index says that two
 * points are less than four edges apart, by the longest edge around them or the average one of the mesh,
 * their distance is the length of a path of GEOIDX_PATH_STRAIGHT, of a shortest one in its corridor where
 * that is shorter, or of one of the ways above: of edges that are long for the distance, vertices tell
 * little. That takes tens of microseconds, on surfaces of few large triangles some hundred. It takes scratch
 * from the global heap each time, and from the index's allocator as paths do. It is given up after 2000
 * triangles, or where more than 1000 vertices are in the corridor and more than 2000 triangles near enough
 * to both points in space, and by GEOIDX_ENGINE_GRAPH it is not done. All other distances are to the accuracy
 * of the index. Points of triangles that share a corner are no farther apart than the way over it is long
 * and, by GEOIDX_METRIC_EXACT, than a straight line around it over the triangles between the two, unless it
 * passes an edge of three triangles or more, or a triangle without area. +INFINITY where there is no path. */
GEOIDX_API geoidx_status geoidx_query_point_sssd(geoidx_query* query, const geoidx_surface* surface,
                                                 const geoidx_surface_point* source,
                                                 const geoidx_surface_point* target, float* distance);

/* geoidx_query_msad from points of the surface: distances[v] is the least of offsets[i] + the distance from
 * sources[i] to v. `offsets` are finite and not negative; NULL: all are 0. An offset that all sources have is
 * added to the distances without it. By GEOIDX_METRIC_EXACT the distance to a vertex that a source within a
 * triangle sees over the triangles around it, 30 or so and up to 126 where edges are long, is no longer than
 * that straight line and, from one source, no shorter than the line in space; a source in a triangle less
 * than a millionth of its longest edge high sees the triangles beside it only. Each call takes 10 KB of
 * scratch a source from the global heap, as does each of the other geoidx_query_point_* below. */
GEOIDX_API geoidx_status geoidx_query_point_msad(geoidx_query* query, const geoidx_surface* surface,
                                                 const geoidx_surface_point* sources, uint32_t source_count,
                                                 const float* offsets, float* distances,
                                                 uint32_t distance_count);

/* geoidx_query_nearest_sources of points of the surface: that of the least offsets[i] + the distance from
 * sources[i]. Of several at one vertex it is the first. distances[v] are the same bits as those of
 * geoidx_query_point_msad; `distances` may be NULL. */
GEOIDX_API geoidx_status geoidx_query_point_nearest_sources(
    geoidx_query* query, const geoidx_surface* surface, const geoidx_surface_point* sources,
    uint32_t source_count, const float* offsets, uint32_t* nearest, float* distances, uint32_t vertex_count);

/* geoidx_query_within from points of the surface: the vertices v for which the least of offsets[i] + the
 * distance from sources[i] is no more than `radius`, the nearest first. From one source the distances are the
 * same bits as those of geoidx_query_point_msad; from several they are the least of those from each. */
GEOIDX_API geoidx_status geoidx_query_point_within(geoidx_query* query, const geoidx_surface* surface,
                                                   const geoidx_surface_point* sources, uint32_t source_count,
                                                   const float* offsets, float radius, uint32_t* vertices,
                                                   float* distances, uint32_t capacity, uint32_t* count);

/* geoidx_query_nearest_targets of points of the surface: few targets are asked for one by one, as by
 * geoidx_query_point_sssd; the distances of many come from fields, as those of geoidx_query_point_msad, but
 * for those that are as near as geoidx_query_point_sssd looks for a path: these are as by that, take as long
 * and the same scratch. The distances of the two kinds differ by the error of the index. A point of which a
 * corner cannot be reached is not reached either. */
GEOIDX_API geoidx_status geoidx_query_point_nearest_targets(
    geoidx_query* query, const geoidx_surface* surface, const geoidx_surface_point* source,
    const geoidx_surface_point* targets, uint32_t target_count, uint32_t* positions, float* distances,
    uint32_t capacity, uint32_t* count);

/* ---- Paths
 * ------------------------------------------------------------------------------ */

/* Which metrics have paths, and where these lead. `surface` needs the costs that the index was built with;
 * without them, or with others, GEOIDX_ERROR_INVALID_ARGUMENT.
 *
 * GEOIDX_METRIC_EXACT: over the surface.
 *
 * GEOIDX_METRIC_WEIGHTED: over the surface, bent at edges between triangles of different cost. The length is
 * the sum of the pieces' lengths, each times the cost of its triangle, along an edge that of the cheapest one
 * there, and of duplicate triangles that of the cheapest, though a path names the first. It is never below
 * the true distance and, unlike that of geoidx_solver_distances, not tied to points_per_edge points, so that
 * it is mostly a little shorter.
 *
 * GEOIDX_METRIC_EDGES: over vertices, along edges, the shortest way that a search led by the distances of the
 * index finds. Where these are wrong, as for edge costs that differ by many orders of magnitude, it may be
 * much longer than the shortest. With edge costs, both ends must be at vertices, since what a way within a
 * triangle costs is not known; the length is the sum of the costs.
 *
 * GEOIDX_METRIC_CALLBACK: likewise, and both ends must be at vertices: the library knows the metric between
 * vertices only, so that a path cannot turn elsewhere. The length is the sum of the index's distances
 * (geoidx_query_sssd) between consecutive vertices. Where the metric is much shorter than ways along edges,
 * many vertices are looked at. An edge whose ends no path joins by the metric is not used.
 *
 * With edge_lengths there are no paths, since positions do not say how the triangles lie:
 * GEOIDX_ERROR_INVALID_ARGUMENT. */
enum {
    /* A path that is locally shortest: no vertex that it passes can be passed on a shorter side. Its length
     * is never below the distance and mostly equal to it. Where it is longer than the index says that its
     * ends are apart, by more than the p99 of the errors (0.1 % at least), a corridor of up to 1,000 vertices
     * is searched as by GEOIDX_PATH_EXACT (GEOIDX_METRIC_EXACT). */
    GEOIDX_PATH_STRAIGHT = 0,
    /* GEOIDX_METRIC_EXACT: the shortest path within a corridor, the vertices that a path as short as the
     * straight one can lead over unless the index errs by more than the largest error stated for it. There
     * distances are computed by the metric itself. GEOIDX_METRIC_WEIGHTED: the best path over points_per_edge
     * points of each edge in a corridor by the p99.9 of the errors, then made locally shortest. */
    GEOIDX_PATH_EXACT = 1
};

/* A point of a path: on a triangle of the caller's, and in space. With weld_tolerance, `position` is where
 * the point lies on the welded triangle; by its weights on the caller's own triangle it lies up to the
 * tolerance away from there. */
typedef struct geoidx_path_point {
    geoidx_surface_point point;
    double position[3];
} geoidx_path_point;

/* Finds a path and keeps it in the query until the next call of this function, also one that fails; *length
 * is the sum of the lengths of its pieces, as the metric has it. `quality` is a GEOIDX_PATH_*; paths over
 * vertices are the same by both. GEOIDX_ERROR_NO_PATH if no path joins the points, as in different
 * components. Between a point and itself there is a path of length 0. A path has its own scratch from the
 * global heap. */
GEOIDX_API geoidx_status geoidx_query_path(geoidx_query* query, const geoidx_surface* surface,
                                           const geoidx_surface_point* source,
                                           const geoidx_surface_point* target, uint32_t quality,
                                           double* length);

/* The points of the latest path, from source to target: at least two. *count is set to their number,
 * also where capacity is too small, and to 0 if there is no path or query is NULL; when capacity is smaller,
 * nothing is written and GEOIDX_ERROR_INVALID_ARGUMENT is returned, unless points is NULL and capacity 0,
 * which asks for the number and succeeds. The piece from each point to the next one is the straight line, on
 * the triangle of the first of them. Two points in a row may be at one position, where the path passes a
 * triangle without area: they are on both sides of it. */
GEOIDX_API geoidx_status geoidx_query_path_points(const geoidx_query* query, geoidx_path_point* points,
                                                  uint64_t capacity, uint64_t* count);

/* Keeps the target of geoidx_query_next_step until the next call of this function for the query. One that
 * fails leaves none. */
GEOIDX_API geoidx_status geoidx_query_prepare_target(geoidx_query* query, const geoidx_surface* surface,
                                                     const geoidx_surface_point* target);

/* The next step of whoever walks to the target that was prepared and asks on the way, wherever it is. `step`
 * has room for two points on one triangle: step[0] is `from` on the triangle that the way crosses next, and
 * step[1] is where the way leaves it, or the target, so that the direction leads from one position to the
 * other. Steps that begin where the one before ended lead to the target as GEOIDX_PATH_STRAIGHT does; at the
 * target both points are the same. *distance, how long the way is from `from` on, is 0 there; it may be NULL.
 * The first step takes as long as a path, whose triangles are kept. From any point of these a step takes a
 * few microseconds (by other metrics than GEOIDX_METRIC_EXACT from points of the path only); from elsewhere,
 * and where the way over these triangles is longer than the index says that the target is away, a new path is
 * found.
 * GEOIDX_ERROR_NO_PATH if the target is in another component; GEOIDX_ERROR_INVALID_ARGUMENT if none was
 * prepared. Where paths lead over vertices, steps do from corner to corner. `surface` is the one of the
 * target. */
GEOIDX_API geoidx_status geoidx_query_next_step(geoidx_query* query, const geoidx_surface* surface,
                                                const geoidx_surface_point* from, geoidx_path_point* step,
                                                double* distance);

/* ---- Distances without an index
 * ------------------------------------------------------------------------------ */

/* A mesh and a metric, ready to compute. Of the options, metric and its parameters, weld_tolerance,
 * refuse_edges_of_many, metric_flags and solver_tolerance count, with the same limits; options may be NULL.
 * To be closed with geoidx_solver_close.
 */
GEOIDX_API geoidx_status geoidx_solver_create(const geoidx_mesh* mesh, const geoidx_build_options* options,
                                              geoidx_solver** out);
GEOIDX_API void geoidx_solver_close(geoidx_solver* solver);

/* distances[i]: from targets[i] to the nearest of 1 or more sources under the metric itself. The computation
 * stops when all targets are final. With targets NULL, target_count must be the mesh's vertex_count and every
 * vertex is a target. */
GEOIDX_API geoidx_status geoidx_solver_distances(geoidx_solver* solver, const uint32_t* sources,
                                                 uint32_t source_count, const uint32_t* targets,
                                                 uint32_t target_count, double* distances);

/* distances[i]: from targets[i] to the nearest of 1 or more sources, which are points of the surface. For
 * GEOIDX_METRIC_EXACT and _WEIGHTED only. */
GEOIDX_API geoidx_status geoidx_solver_point_distances(geoidx_solver* solver,
                                                       const geoidx_surface_point* sources,
                                                       uint32_t source_count,
                                                       const geoidx_surface_point* targets,
                                                       uint32_t target_count, double* distances);

#ifdef __cplusplus
}
#endif

#endif
