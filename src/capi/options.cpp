// Versions, and structs with their defaults.
#include "geoidx.h"
#include "src/capi/structs.h"

using namespace geodesic;

uint32_t geoidx_abi_version(void) { return GEOIDX_ABI_VERSION; }

uint32_t geoidx_version(void) {
    return GEOIDX_VERSION_MAJOR * 10000 + GEOIDX_VERSION_MINOR * 100 + GEOIDX_VERSION_PATCH;
}

void geoidx_mesh_init_sized(geoidx_mesh* mesh, uint32_t struct_size) { init_sized(mesh, struct_size, {}); }

void geoidx_build_options_init_sized(geoidx_build_options* options, uint32_t struct_size) {
    geoidx_build_options defaults{};
    defaults.lloyd_iterations = 4;
    defaults.points_per_edge = 12;
    defaults.engine = GEOIDX_ENGINE_OVERLAY;
    defaults.exact_vertices = 400;
    defaults.rounding = 1.0 / 64;
    defaults.target_error = 0.0005;
    init_sized(options, struct_size, defaults);
}

void geoidx_save_options_init_sized(geoidx_save_options* options, uint32_t struct_size) {
    init_sized(options, struct_size, {});
}

void geoidx_open_options_init_sized(geoidx_open_options* options, uint32_t struct_size) {
    init_sized(options, struct_size, {});
}

void geoidx_surface_options_init_sized(geoidx_surface_options* options, uint32_t struct_size) {
    geoidx_surface_options defaults{};
    defaults.points_per_edge = 12;
    init_sized(options, struct_size, defaults);
}
