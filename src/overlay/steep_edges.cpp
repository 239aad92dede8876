#include "src/overlay/steep_edges.h"

#include <algorithm>

namespace geodesic {

void take_steep_edges(std::span<const VertexPair> edges, uint32_t vertex_count, SteepEdges& steep) {
    steep.edges.assign(edges.begin(), edges.end());
    std::ranges::stable_sort(steep.edges, {}, &VertexPair::second);
    steep.begin.clear();
    steep.ends.clear();
    if (edges.empty()) return;
    steep.begin.resize(SteepEdges::block_of(vertex_count) + 2, 0);
    for (const VertexPair& edge : edges)
        for (const uint32_t end : {edge.first, edge.second}) ++steep.begin[SteepEdges::block_of(end) + 1];
    for (size_t b = 1; b < steep.begin.size(); ++b) steep.begin[b] += steep.begin[b - 1];
    steep.ends.resize(2 * edges.size());
    std::vector<uint32_t> next(steep.begin.begin(), steep.begin.end() - 1);
    for (const auto& [first, second, limit] : edges) {
        steep.ends[next[SteepEdges::block_of(first)]++] = {first, second, limit};
        steep.ends[next[SteepEdges::block_of(second)]++] = {second, first, limit};
    }
}

std::vector<VertexPair> restore_steep_edges(const SteepEdges& steep) {
    std::vector<VertexPair> edges(steep.edges.begin(), steep.edges.end());
    std::ranges::stable_sort(edges, {}, &VertexPair::first);
    return edges;
}

}
