#include "src/tables/distance_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/index/table_rows.h"

namespace geodesic {

namespace {

constexpr float INFINITE = std::numeric_limits<float>::infinity();

float longest(std::span<const float> distances) {
    float longest = 0;
    for (float d : distances)
        if (d < INFINITE) longest = std::max(longest, d);
    return longest;
}

// Only a distance of 0 is rounded to 0, so that different vertices stay apart.
uint16_t code_of(float distance, float quantum) {
    if (distance == INFINITE) return OverlayTables::UNREACHED;
    if (distance == 0 || !(quantum > 0)) return 0;
    const double code = std::round(double{distance} / double{quantum});
    return static_cast<uint16_t>(std::clamp(code, 1.0, double{OverlayTables::LARGEST}));
}

void encode_outer(const DistanceTables& tables, uint32_t patch, Index& index) {
    const uint32_t parent = index.parent[patch];
    const size_t size = index.overlay_size(parent);
    const float quantum = index.overlay_tables.quantum[parent];
    fill_outer_table(index, patch, [&](uint32_t i, uint32_t j) {
        return code_of(tables.overlay[parent][i * size + j], quantum);
    });
}

void encode_inner(const DistanceTables& tables, uint32_t patch, Index& index) {
    const size_t border = index.border_size(patch);
    const float quantum = index.overlay_tables.quantum[patch];
    if (patch >= index.first_leaf())
        return fill_inner_table(index, patch, [&](uint32_t i, uint32_t position) {
            return code_of(tables.crossing[index.crossing_place(patch, position, i)], quantum);
        });
    const size_t size = index.overlay_size(patch);
    fill_inner_table(index, patch, [&](uint32_t i, uint32_t position) {
        return code_of(tables.overlay[patch][(border + i) * size + position], quantum);
    });
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
    codes.quantum.clear();
    for (const auto& table : tables.overlay) codes.quantum.push_back(longest(table) / OverlayTables::LARGEST);
    for (uint32_t leaf = index.first_leaf(); leaf < index.patch_count(); ++leaf) {
        const auto of_leaf = [&](const std::vector<float>& all, const Array<uint64_t>& begin) {
            const uint64_t first = begin[leaf - index.first_leaf()];
            return std::span(all).subspan(first, begin[leaf - index.first_leaf() + 1] - first);
        };
        const auto crossing = of_leaf(tables.crossing, index.crossing_table_begin);
        const auto internal = of_leaf(tables.internal, index.internal_table_begin);
        const float quantum = std::max(longest(crossing), longest(internal)) / OverlayTables::LARGEST;
        codes.quantum.push_back(quantum);
        uint16_t* out = codes.internal_tables.data() + index.internal_table_begin[leaf - index.first_leaf()];
        for (float distance : internal) *out++ = code_of(distance, quantum);
    }
    // Labels of what lies deeper count in steps of this quantum, also where all borders meet in one vertex.
    for (uint32_t p = index.patch_count() - 1; p > 0; --p) {
        float& of_parent = codes.quantum[index.parent[p]];
        if (longest(tables.overlay[index.parent[p]]) == 0) of_parent = std::max(of_parent, codes.quantum[p]);
    }
    for (uint32_t p = 1; p < index.patch_count(); ++p) {
        encode_outer(tables, p, index);
        encode_inner(tables, p, index);
    }
}

}
