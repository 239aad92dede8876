#include "src/overlay/tables/steep_edges.h"

#include <algorithm>

namespace geodesic {

void take_steep_edges(std::span<const VertexPair> edges, uint32_t vertex_count, SteepEdges& steep) {
    take_pairs(edges, vertex_count, steep);
    steep.edges.assign(edges.begin(), edges.end());
    std::ranges::stable_sort(steep.edges, {}, &VertexPair::second);
}

}
