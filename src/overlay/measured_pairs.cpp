#include "src/overlay/measured_pairs.h"

#include <algorithm>

namespace geodesic {

std::span<const MeasuredPairs::Other> MeasuredPairs::of(uint32_t key, uint32_t first, uint32_t end) const {
    if (size_t{key} + 1 >= begin.size()) return {};
    const auto all = of(key);
    const auto from = std::ranges::lower_bound(all, first, {}, &Other::number);
    return {from, std::ranges::lower_bound(from, all.end(), end, {}, &Other::number)};
}

const float* MeasuredPairs::distance(uint32_t first, uint32_t second) const {
    const auto pairs = of(first);
    if (pairs.empty()) return nullptr;
    const auto found = std::ranges::lower_bound(pairs, second, {}, &Other::number);
    return found != pairs.end() && found->number == second ? &found->distance : nullptr;
}

// The pairs of a vertex as the second one of them come before those as the first one, whose other vertices
// have larger numbers.
void take_measured_pairs(std::span<const VertexPair> pairs, uint32_t vertex_count, MeasuredPairs& measured) {
    measured.begin.clear();
    measured.others.clear();
    if (pairs.empty()) return;
    measured.begin.resize(size_t{vertex_count} + 1, 0);
    for (const VertexPair& pair : pairs)
        for (const uint32_t number : {pair.first, pair.second}) ++measured.begin[number + 1];
    for (uint32_t v = 0; v < vertex_count; ++v) measured.begin[v + 1] += measured.begin[v];
    measured.others.resize(2 * pairs.size());
    std::vector<uint32_t> next(measured.begin.begin(), measured.begin.end() - 1);
    for (const VertexPair& pair : pairs) measured.others[next[pair.second]++] = {pair.first, pair.distance};
    for (const VertexPair& pair : pairs) measured.others[next[pair.first]++] = {pair.second, pair.distance};
}

std::vector<VertexPair> restore_measured_pairs(const MeasuredPairs& measured) {
    std::vector<VertexPair> pairs;
    for (uint32_t v = 0; v + 1 < measured.begin.size(); ++v)
        for (const auto& [other, distance] : measured.of(v))
            if (v < other) pairs.push_back({v, other, distance});
    return pairs;
}

}
