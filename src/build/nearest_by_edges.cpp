#include "src/build/nearest_by_edges.h"

namespace geodesic {

std::vector<uint32_t> nearest_by_edges(const Mesh& mesh, std::span<const uint32_t> from, size_t count) {
    std::vector<uint32_t> nearest;
    std::vector<bool> is_found(mesh.vertex_count(), false);
    const auto find = [&](uint32_t v) {
        if (is_found[v] || nearest.size() == count) return;
        is_found[v] = true;
        nearest.push_back(v);
    };
    for (const uint32_t v : from) find(v);
    for (size_t i = 0; i < nearest.size() && nearest.size() < count; ++i)
        for (const uint32_t v : neighbours(mesh, nearest[i])) find(v);
    return nearest;
}

}
