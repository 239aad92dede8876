#include "tests/capi/shared_index.h"

#include <map>
#include <string>

#include <doctest/doctest.h>

#include "tests/capi/calls.h"

namespace geodesic::test {
namespace {

template <typename T>
void append(std::string& key, const T* values, uint64_t count) {
    if (values) key.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

// Equal for meshes and options of equal content, wherever their arrays lie.
std::string content_of(const geoidx_mesh& mesh, geoidx_build_options options) {
    std::string key;
    REQUIRE(mesh.position_stride == 0);
    if (mesh.position_type == GEOIDX_POSITION_DOUBLE)
        append(key, static_cast<const double*>(mesh.positions), 3 * mesh.vertex_count);
    else
        append(key, static_cast<const float*>(mesh.positions), 3 * mesh.vertex_count);
    append(key, mesh.triangles, 3 * mesh.triangle_count);
    append(key, options.edge_cost_vertices, 2 * uint64_t{options.edge_cost_count});
    append(key, options.edge_costs, options.edge_cost_count);
    append(key, options.face_costs, options.face_cost_count);
    append(key, options.edge_lengths, options.edge_length_count);
    options.edge_cost_vertices = nullptr;
    options.edge_costs = options.face_costs = options.edge_lengths = nullptr;
    append(key, &mesh.position_type, 1);
    append(key, &mesh.vertex_count, 1);
    append(key, &options, 1);
    return key;
}

std::shared_ptr<const geoidx> build(const geoidx_mesh& mesh, const geoidx_build_options& options) {
    geoidx* index = nullptr;
    require_success(geoidx_build(&mesh, &options, &index));
    return {index, geoidx_close};
}

}

std::shared_ptr<const geoidx> shared_index(const geoidx_mesh& mesh, const geoidx_build_options& options) {
    if (options.metric_callback || options.progress || options.allocator.allocate)
        return build(mesh, options);
    static std::map<std::string, std::shared_ptr<const geoidx>> built;
    std::shared_ptr<const geoidx>& index = built[content_of(mesh, options)];
    if (!index) index = build(mesh, options);
    return index;
}

}
