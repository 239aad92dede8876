/* geoidx.h in C99: every function has the documented type, and a program from build to answer works. Returns
 * 0, or the number of the line that failed. */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "geoidx.h"

int geoidx_header_test(void);

#define EXPECT(condition)                                                                                    \
    do {                                                                                                     \
        if (!(condition)) return __LINE__;                                                                   \
    } while (0)

/* A function whose type differs from geoidx.h's does not compile here. */
static uint32_t (*const version)(void) = geoidx_version;
static uint32_t (*const abi_version)(void) = geoidx_abi_version;
static const char* (*const status_string)(geoidx_status) = geoidx_status_string;
static const char* (*const last_error)(void) = geoidx_last_error;
static void (*const mesh_init)(geoidx_mesh*) = geoidx_mesh_init;
static void (*const build_options_init)(geoidx_build_options*) = geoidx_build_options_init;
static void (*const open_options_init)(geoidx_open_options*) = geoidx_open_options_init;
static void (*const mesh_init_sized)(geoidx_mesh*, uint32_t) = geoidx_mesh_init_sized;
static void (*const build_options_init_sized)(geoidx_build_options*,
                                              uint32_t) = geoidx_build_options_init_sized;
static void (*const open_options_init_sized)(geoidx_open_options*, uint32_t) = geoidx_open_options_init_sized;
static geoidx_status (*const build)(const geoidx_mesh*, const geoidx_build_options*, geoidx**) = geoidx_build;
static geoidx_status (*const save)(const geoidx*, const char*, const geoidx_save_options*) = geoidx_save;
static geoidx_status (*const save_memory)(const geoidx*, const geoidx_save_options*, void*, uint64_t,
                                          uint64_t*) = geoidx_save_memory;
static geoidx_status (*const open_file)(const char*, const geoidx_open_options*, geoidx**) = geoidx_open;
static geoidx_status (*const open_memory)(const void*, uint64_t, const geoidx_open_options*,
                                          geoidx**) = geoidx_open_memory;
static void (*const close_index)(geoidx*) = geoidx_close;
static geoidx_status (*const get_info)(const geoidx*, geoidx_info*) = geoidx_get_info;
static geoidx_status (*const verify)(const void*, uint64_t, geoidx_issue_fn, void*) = geoidx_verify;
static geoidx_status (*const sssd)(const geoidx*, uint32_t, uint32_t, float*) = geoidx_sssd;
static geoidx_status (*const sssd_batch)(const geoidx*, const uint32_t*, uint64_t,
                                         float*) = geoidx_sssd_batch;
static geoidx_status (*const msad)(const geoidx*, const uint32_t*, uint32_t, float*, uint32_t) = geoidx_msad;
static geoidx_status (*const query_create)(const geoidx*, geoidx_query**) = geoidx_query_create;
static void (*const query_close)(geoidx_query*) = geoidx_query_close;
static geoidx_status (*const query_sssd)(geoidx_query*, uint32_t, uint32_t, float*) = geoidx_query_sssd;
static geoidx_status (*const query_msad)(geoidx_query*, const uint32_t*, uint32_t, float*,
                                         uint32_t) = geoidx_query_msad;
static geoidx_status (*const query_msad_within)(geoidx_query*, const uint32_t*, uint32_t, float, float*,
                                                uint32_t) = geoidx_query_msad_within;
static geoidx_status (*const matrix)(const geoidx*, const uint32_t*, uint32_t, const uint32_t*, uint32_t,
                                     float*, uint64_t) = geoidx_matrix;
static geoidx_status (*const query_matrix)(geoidx_query*, const uint32_t*, uint32_t, const uint32_t*,
                                           uint32_t, float*, uint64_t) = geoidx_query_matrix;
static geoidx_status (*const query_nearest_sources)(geoidx_query*, const uint32_t*, uint32_t, uint32_t*,
                                                    float*, uint32_t) = geoidx_query_nearest_sources;
static geoidx_status (*const query_within)(geoidx_query*, const uint32_t*, uint32_t, float, uint32_t*, float*,
                                           uint32_t, uint32_t*) = geoidx_query_within;
static geoidx_status (*const query_nearest_targets)(geoidx_query*, uint32_t, const uint32_t*, uint32_t,
                                                    uint32_t*, float*, uint32_t,
                                                    uint32_t*) = geoidx_query_nearest_targets;
static geoidx_status (*const query_farthest_points)(geoidx_query*, const uint32_t*, uint32_t, uint32_t,
                                                    uint32_t*, float*,
                                                    uint32_t*) = geoidx_query_farthest_points;
static geoidx_status (*const query_set_threads)(geoidx_query*, uint32_t) = geoidx_query_set_threads;
static geoidx_status (*const query_ssad_batch)(geoidx_query*, const uint32_t*, uint32_t, float*,
                                               uint64_t) = geoidx_query_ssad_batch;
static geoidx_status (*const ssad_batch)(const geoidx*, const uint32_t*, uint32_t, float*,
                                         uint64_t) = geoidx_ssad_batch;
static geoidx_status (*const query_prepare)(geoidx_query*, uint32_t) = geoidx_query_prepare;
static geoidx_status (*const query_prepared)(geoidx_query*, const uint32_t*, uint64_t,
                                             float*) = geoidx_query_prepared;
static geoidx_status (*const solver_create)(const geoidx_mesh*, const geoidx_build_options*,
                                            geoidx_solver**) = geoidx_solver_create;
static void (*const solver_close)(geoidx_solver*) = geoidx_solver_close;
static geoidx_status (*const solver_distances)(geoidx_solver*, const uint32_t*, uint32_t, const uint32_t*,
                                               uint32_t, double*) = geoidx_solver_distances;

static geoidx_status (*const surface_create)(const geoidx_mesh*, const geoidx_surface_options*,
                                             geoidx_surface**) = geoidx_surface_create;
static geoidx_status (*const surface_of_index)(const geoidx*, const geoidx_surface_options*,
                                               geoidx_surface**) = geoidx_surface_of_index;
static void (*const surface_close)(geoidx_surface*) = geoidx_surface_close;
static geoidx_status (*const vertex_point)(const geoidx_surface*, uint32_t,
                                           geoidx_surface_point*) = geoidx_vertex_point;

enum { SIDE = 6, COUNT = SIDE * SIDE, TRIANGLES = 2 * (SIDE - 1) * (SIDE - 1) };

static float positions[COUNT][3];
static uint32_t triangles[TRIANGLES][3];

static void make_grid(geoidx_mesh* mesh) {
    uint32_t x, y, t = 0;
    for (y = 0; y < SIDE; ++y)
        for (x = 0; x < SIDE; ++x) {
            positions[y * SIDE + x][0] = (float)x;
            positions[y * SIDE + x][1] = (float)y;
            positions[y * SIDE + x][2] = 0;
        }
    for (y = 0; y + 1 < SIDE; ++y)
        for (x = 0; x + 1 < SIDE; ++x, t += 2) {
            const uint32_t a = y * SIDE + x;
            triangles[t][0] = a;
            triangles[t][1] = a + 1;
            triangles[t][2] = a + SIDE + 1;
            triangles[t + 1][0] = a;
            triangles[t + 1][1] = a + SIDE + 1;
            triangles[t + 1][2] = a + SIDE;
        }
    mesh_init(mesh);
    mesh_init_sized(mesh, mesh->struct_size);
    mesh->positions = positions;
    mesh->vertex_count = COUNT;
    mesh->triangles = triangles[0];
    mesh->triangle_count = TRIANGLES;
}

static int32_t count_issue(void* user, const geoidx_issue* issue) {
    if (issue->number > 0 && issue->status < 0 && issue->message) ++*(int*)user;
    return 1;
}

/* A flat convex mesh: the distance is the straight line. */
static int is_straight(uint32_t a, uint32_t b, double distance) {
    const double x = positions[a][0] - positions[b][0], y = positions[a][1] - positions[b][1];
    return fabs(distance - sqrt(x * x + y * y)) < 0.1;
}

static int check_queries(const geoidx* index) {
    geoidx_query* query = NULL;
    const uint32_t sources[2] = {0, COUNT - 1}, pairs[4] = {0, COUNT - 1, 5, 5};
    float all[COUNT], same[COUNT], batch[2], one = -1;
    uint32_t farthest = COUNT, found = 0, nearest[COUNT], few[2];
    EXPECT(sssd(index, 0, COUNT - 1, &one) == GEOIDX_OK && is_straight(0, COUNT - 1, one));
    EXPECT(sssd_batch(index, pairs, 2, batch) == GEOIDX_OK && batch[0] == one && batch[1] == 0);
    EXPECT(msad(index, sources, 2, all, COUNT) == GEOIDX_OK && is_straight(0, SIDE - 1, all[SIDE - 1]));
    EXPECT(query_create(index, &query) == GEOIDX_OK);
    EXPECT(query_sssd(query, 0, COUNT - 1, &one) == GEOIDX_OK && one == batch[0]);
    EXPECT(query_msad(query, sources, 2, same, COUNT) == GEOIDX_OK && memcmp(all, same, sizeof all) == 0);
    EXPECT(query_msad_within(query, sources, 2, 1e30f, same, COUNT) == GEOIDX_OK &&
           memcmp(all, same, sizeof all) == 0);
    EXPECT(query_farthest_points(query, sources, 2, 1, &farthest, &one, &found) == GEOIDX_OK && found == 1 &&
           one == all[farthest]);
    EXPECT(query_nearest_sources(query, sources, 2, nearest, same, COUNT) == GEOIDX_OK &&
           memcmp(all, same, sizeof all) == 0 && nearest[1] == 0 && nearest[COUNT - 2] == 1);
    EXPECT(query_within(query, sources, 2, 0, few, batch, 2, &found) == GEOIDX_OK && found == 2 &&
           few[0] == 0 && few[1] == COUNT - 1 && batch[1] == 0);
    EXPECT(query_nearest_targets(query, 1, sources, 2, few, batch, 1, &found) == GEOIDX_OK && found == 1 &&
           few[0] == 0 && is_straight(0, 1, batch[0]));
    EXPECT(matrix(index, sources, 2, sources, 1, batch, 2) == GEOIDX_OK && batch[0] == 0 &&
           is_straight(0, COUNT - 1, batch[1]));
    EXPECT(query_matrix(query, sources, 2, sources, 1, same, 2) == GEOIDX_OK && same[1] == batch[1]);
    EXPECT(query_set_threads(query, 2) == GEOIDX_OK);
    EXPECT(query_msad(query, sources, 2, same, COUNT) == GEOIDX_OK && memcmp(all, same, sizeof all) == 0);
    EXPECT(ssad_batch(index, sources, 1, all, COUNT) == GEOIDX_OK);
    EXPECT(query_ssad_batch(query, sources, 1, same, COUNT) == GEOIDX_OK &&
           memcmp(all, same, sizeof all) == 0);
    EXPECT(query_prepare(query, 0) == GEOIDX_OK);
    EXPECT(query_prepared(query, sources, 2, same) == GEOIDX_OK);
    query_close(query);
    return 0;
}

static int check_memory(const geoidx* index) {
    uint64_t size = 0;
    void* bytes;
    geoidx* opened = NULL;
    geoidx_open_options options;
    int issues = 0, failed;
    EXPECT(save_memory(index, NULL, NULL, 0, &size) == GEOIDX_OK && size > 0);
    bytes = malloc((size_t)size);
    EXPECT(bytes && save_memory(index, NULL, bytes, size, &size) == GEOIDX_OK);
    EXPECT(verify(bytes, size, count_issue, &issues) == GEOIDX_OK && issues == 0);
    EXPECT(verify(bytes, size - 1, count_issue, &issues) == GEOIDX_ERROR_TRUNCATED && issues > 0);
    open_options_init(&options);
    open_options_init_sized(&options, options.struct_size);
    EXPECT(open_memory(bytes, size, &options, &opened) == GEOIDX_OK);
    free(bytes);
    failed = check_queries(opened);
    close_index(opened);
    return failed;
}

static int check_file(const geoidx* index) {
    static const char name[] = "geoidx_header_test.gidx";
    geoidx* opened = NULL;
    int failed;
    EXPECT(save(index, name, NULL) == GEOIDX_OK);
    EXPECT(open_file(name, NULL, &opened) == GEOIDX_OK);
    EXPECT(remove(name) == 0);
    failed = check_queries(opened);
    close_index(opened);
    return failed;
}

static int check_surfaces(const geoidx* index, const geoidx_mesh* mesh) {
    geoidx_surface *kept = NULL, *own = NULL;
    geoidx_surface_point a, b;
    EXPECT(surface_of_index(index, NULL, &kept) == GEOIDX_OK);
    EXPECT(surface_create(mesh, NULL, &own) == GEOIDX_OK);
    EXPECT(vertex_point(kept, COUNT - 1, &a) == GEOIDX_OK && vertex_point(own, COUNT - 1, &b) == GEOIDX_OK);
    EXPECT(a.triangle == b.triangle && memcmp(a.weights, b.weights, sizeof a.weights) == 0);
    EXPECT(vertex_point(kept, COUNT, &a) == GEOIDX_ERROR_INVALID_ARGUMENT);
    surface_close(kept);
    surface_close(own);
    return 0;
}

static int check_solver(const geoidx_mesh* mesh) {
    geoidx_solver* solver = NULL;
    const uint32_t source = 0, target = COUNT - 1;
    double distance = -1;
    EXPECT(solver_create(mesh, NULL, &solver) == GEOIDX_OK);
    EXPECT(solver_distances(solver, &source, 1, &target, 1, &distance) == GEOIDX_OK);
    EXPECT(fabs(distance - (SIDE - 1) * sqrt(2.0)) < 1e-12);
    solver_close(solver);
    return 0;
}

int geoidx_header_test(void) {
    geoidx_mesh mesh;
    geoidx_build_options options;
    geoidx_info info;
    geoidx* index = NULL;
    int failed;
    EXPECT(version() / 10000 == GEOIDX_VERSION_MAJOR);
    EXPECT(abi_version() == GEOIDX_ABI_VERSION);
    EXPECT(strcmp(status_string(GEOIDX_OK), status_string(GEOIDX_ERROR_IO)) != 0);
    make_grid(&mesh);
    build_options_init(&options);
    build_options_init_sized(&options, options.struct_size);
    options.level_count = 1;
    options.store_mesh = 1;
    options.patches[0] = 4;
    EXPECT(build(&mesh, NULL, NULL) == GEOIDX_ERROR_INVALID_ARGUMENT && strlen(last_error()) > 0);
    EXPECT(build(&mesh, &options, &index) == GEOIDX_OK);
    memset(&info, 0, sizeof info);
    info.struct_size = sizeof info;
    EXPECT(get_info(index, &info) == GEOIDX_OK && info.vertex_count == COUNT && info.level_count == 1);
    failed = check_queries(index);
    if (!failed) failed = check_memory(index);
    if (!failed) failed = check_file(index);
    if (!failed) failed = check_surfaces(index, &mesh);
    if (!failed) failed = check_solver(&mesh);
    close_index(index);
    return failed;
}
