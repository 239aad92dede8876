// Builds indices of small meshes that the input describes, well made or not, and asks of those that are built
// what holds of every distance.
#include <cmath>
#include <cstring>
#include <vector>

#include "geoidx.h"
#include "tests/fuzz/fuzz.h"

using geodesic::fuzz::Input;
using geodesic::fuzz::require;

namespace {

struct FuzzMesh {
    std::vector<float> positions;
    std::vector<uint32_t> triangles;
};

// Few different coordinates, so that vertices, edges and faces coincide or have no size.
FuzzMesh mesh_of(Input& input) {
    constexpr float COORDINATES[] = {0, 1, 2, 0.5f, -1, 1e-7f, 3, 1.0001f};
    FuzzMesh mesh;
    const uint32_t vertices = 1 + input.byte() % 24, triangles = 1 + input.byte() % 40;
    for (uint32_t i = 0; i < vertices; ++i) {
        const uint32_t bits = input.byte() * 2u + i % 2;
        for (uint32_t k = 0; k < 3; ++k) mesh.positions.push_back(COORDINATES[bits >> 3 * k & 7]);
    }
    for (uint32_t i = 0; i < 3 * triangles; ++i) {
        const uint32_t v = input.byte();
        mesh.triangles.push_back(v == 0xFF ? v : v % vertices);
    }
    return mesh;
}

geoidx_build_options options_of(Input& input) {
    geoidx_build_options options;
    geoidx_build_options_init(&options);
    options.metric = input.byte() % 2 ? GEOIDX_METRIC_EDGES : GEOIDX_METRIC_EXACT;
    options.engine = input.byte() % 2;
    options.level_count = input.byte() % 4;
    options.patches[0] = input.byte() % 5;
    options.patches[1] = input.byte() % 5;
    options.exact_vertices = input.byte() % 2 ? 1 : 400;
    options.delta = input.byte() % 4 ? 0 : 5;
    options.weld_tolerance = input.byte() % 4 ? 0 : 0.01;
    options.target_error = options.delta == 0 ? 1e-9 : 0;
    options.threads = 1;
    return options;
}

void check_distances(const geoidx& index, uint32_t count) {
    std::vector<float> from(count);
    for (uint32_t source = 0; source < count; source += 5) {
        require(geoidx_msad(&index, &source, 1, from.data(), count) == GEOIDX_OK, "MSAD");
        require(from[source] == 0, "MSAD is 0 at its source");
        for (uint32_t target = 0; target < count; ++target) {
            float there = 0, back = 0;
            require(geoidx_sssd(&index, source, target, &there) == GEOIDX_OK, "SSSD");
            require(geoidx_sssd(&index, target, source, &back) == GEOIDX_OK, "SSSD back");
            require(std::memcmp(&there, &back, sizeof there) == 0, "SSSD is symmetric");
            require(there >= 0 && from[target] >= 0, "distances are not negative, not NaN");
            require(std::isinf(there) == std::isinf(from[target]), "SSSD and MSAD reach the same");
        }
    }
}

}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    Input input({data, size});
    const geoidx_build_options options = options_of(input);
    const FuzzMesh fuzz_mesh = mesh_of(input);
    geoidx_mesh mesh;
    geoidx_mesh_init(&mesh);
    mesh.positions = fuzz_mesh.positions.data();
    mesh.vertex_count = fuzz_mesh.positions.size() / 3;
    mesh.triangles = fuzz_mesh.triangles.data();
    mesh.triangle_count = fuzz_mesh.triangles.size() / 3;
    geoidx* index = nullptr;
    const geoidx_status status = geoidx_build(&mesh, &options, &index);
    require((status == GEOIDX_OK) == (index != nullptr), "there is an index or an error");
    require(status == GEOIDX_OK || status == GEOIDX_ERROR_BAD_MESH, "only the mesh can be bad");
    if (index) check_distances(*index, static_cast<uint32_t>(mesh.vertex_count));
    geoidx_close(index);
    return 0;
}
