#include "src/tables/distance_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geodesic {

namespace {

constexpr float INFINITE = std::numeric_limits<float>::infinity();

float longest(std::span<const float> distances) {
    float longest = 0;
    for (float d : distances)
        if (d < INFINITE) longest = std::max(longest, d);
    return longest;
}

uint16_t code_of(float distance, float quantum) {
    if (distance == INFINITE) return OverlayTables::UNREACHED;
    const double code = quantum > 0 ? std::round(double{distance} / double{quantum}) : 0;
    return static_cast<uint16_t>(std::min(code, double{OverlayTables::LARGEST}));
}

void encode(std::span<const float> distances, float quantum, uint16_t* codes) {
    for (float distance : distances) *codes++ = code_of(distance, quantum);
}

}

DistanceTables::DistanceTables(const Index& index)
    : crossing(index.crossing_table_begin.back(), INFINITE),
      internal(index.internal_table_begin.back(), INFINITE) {
    for (uint32_t p = 0; p < index.first_leaf(); ++p)
        overlay.emplace_back(size_t{index.overlay_size(p)} * index.overlay_size(p), INFINITE);
}

void quantize(const DistanceTables& tables, Index& index) {
    OverlayTables& codes = index.overlay_tables;
    codes.quantum.assign(index.patch_count(), 0);
    for (uint32_t p = 0; p < index.first_leaf(); ++p) {
        codes.quantum[p] = longest(tables.overlay[p]) / OverlayTables::LARGEST;
        const uint32_t size = index.overlay_size(p);
        for (uint32_t i = 0; i < size; ++i)
            for (uint32_t j = 0; j < size; ++j)
                codes.tables[index.overlay_place(p, i, j)] =
                    code_of(tables.overlay[p][size_t{i} * size + j], codes.quantum[p]);
    }
    for (uint32_t leaf = index.first_leaf(); leaf < index.patch_count(); ++leaf) {
        const auto of_leaf = [&](const std::vector<float>& all, const Array<uint64_t>& begin) {
            const uint64_t first = begin[leaf - index.first_leaf()];
            return std::span(all).subspan(first, begin[leaf - index.first_leaf() + 1] - first);
        };
        const auto crossing = of_leaf(tables.crossing, index.crossing_table_begin);
        const auto internal = of_leaf(tables.internal, index.internal_table_begin);
        const float quantum = std::max(longest(crossing), longest(internal)) / OverlayTables::LARGEST;
        codes.quantum[leaf] = quantum;
        encode(crossing, quantum, codes.crossing_tables.data() + index.crossing_place(leaf, 0, 0));
        encode(internal, quantum,
               codes.internal_tables.data() + index.internal_table_begin[leaf - index.first_leaf()]);
    }
}

}
