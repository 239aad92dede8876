#include "bench/neighbours.h"

#include <algorithm>

namespace geodesic::bench {

Neighbours::Neighbours(const tools::TriangleMesh& mesh) : Neighbours(mesh.vertex_count()) {
    for_each_side(mesh, [&](uint32_t a, uint32_t b) { add(a, b); });
}

bool Neighbours::add(uint32_t a, uint32_t b) {
    if (std::ranges::find(of_[a], b) != of_[a].end()) return false;
    of_[a].push_back(b);
    of_[b].push_back(a);
    return true;
}

std::vector<uint32_t> Neighbours::around(uint32_t center, uint32_t fewest_edges, uint32_t most_edges,
                                         size_t most) const {
    std::vector<uint32_t> reached{center}, found;
    std::vector<bool> is_reached(of_.size(), false);
    is_reached[center] = true;
    size_t i = 0;
    for (uint32_t edges = 1; edges <= most_edges && i < reached.size(); ++edges)
        for (const size_t end = reached.size(); i < end; ++i)
            for (const uint32_t v : of_[reached[i]]) {
                if (is_reached[v]) continue;
                if (found.size() == most) return found;
                is_reached[v] = true;
                reached.push_back(v);
                if (edges >= fewest_edges) found.push_back(v);
            }
    return found;
}

}
