#include "src/overlay/tables/pairs_of_vertices.h"

namespace geodesic {

// The pairs of a vertex as the second one of them come before those as the first one, whose other vertices
// have larger numbers.
void take_pairs(std::span<const VertexPair> pairs, uint32_t vertex_count, PairsOfVertices& taken) {
    taken.begin.clear();
    taken.others.clear();
    if (pairs.empty()) return;
    taken.begin.resize(size_t{vertex_count} + 1, 0);
    for (const VertexPair& pair : pairs)
        for (const uint32_t number : {pair.first, pair.second}) ++taken.begin[number + 1];
    for (uint32_t v = 0; v < vertex_count; ++v) taken.begin[v + 1] += taken.begin[v];
    taken.others.resize(2 * pairs.size());
    std::vector<uint32_t> next(taken.begin.begin(), taken.begin.end() - 1);
    for (const VertexPair& pair : pairs) taken.others[next[pair.second]++] = {pair.first, pair.distance};
    for (const VertexPair& pair : pairs) taken.others[next[pair.first]++] = {pair.second, pair.distance};
}

std::vector<VertexPair> restore_pairs(const PairsOfVertices& taken) {
    std::vector<VertexPair> pairs;
    for (uint32_t v = 0; v + 1 < taken.begin.size(); ++v)
        for (const auto& [other, distance] : taken.of(v))
            if (v < other) pairs.push_back({v, other, distance});
    return pairs;
}

}
