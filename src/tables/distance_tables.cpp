#include "src/tables/distance_tables.h"

#include <algorithm>
#include <span>

#include "src/overlay/codes.h"

namespace geodesic {

namespace {

float longest(std::span<const float> distances) {
    float longest = 0;
    for (float d : distances)
        if (d < INFINITE) longest = std::max(longest, d);
    return longest;
}

// The entries of one leaf in tables that lie end to end.
std::span<const float> of_leaf(const std::vector<float>& all, const Array<uint64_t>& begin, size_t leaf) {
    return std::span(all).subspan(begin[leaf], begin[leaf + 1] - begin[leaf]);
}

std::vector<float> smallest_quanta(const DistanceTables& tables, const Numbering& numbering) {
    std::vector<float> quantum;
    for (const auto& table : tables.overlay) quantum.push_back(longest(table) / TableCode::LARGEST);
    for (size_t leaf = 0; leaf + 1 < numbering.internal_begin.size(); ++leaf)
        quantum.push_back(
            std::max(longest(of_leaf(tables.border_internal, numbering.border_internal_begin, leaf)),
                     longest(of_leaf(tables.internal, numbering.internal_table_begin, leaf))) /
            TableCode::LARGEST);
    // The labels of deeper vertices count in steps of this quantum, so that it must not be 0 where a table
    // has no distance but 0, as it is if all its borders meet in one vertex.
    for (uint32_t p = numbering.patch_count() - 1; p > 0; --p) {
        const uint32_t parent = numbering.parent[p];
        if (longest(tables.overlay[parent]) == 0) quantum[parent] = std::max(quantum[parent], quantum[p]);
    }
    return quantum;
}

// Adds the codes of owned x border, then those of owned x owned below the diagonal.
void hand_over_overlay(std::span<const float> table, uint32_t patch, const Numbering& numbering,
                       StoredIndex& stored) {
    const size_t border = numbering.border_size(patch), size = numbering.overlay_size(patch);
    const auto add = [&](size_t i, size_t j) {
        stored.overlay_codes.push_back(TableCode::nearest_to(table[i * size + j], stored.quantum[patch]));
    };
    for (size_t i = border; i < size; ++i)
        for (size_t j = 0; j < border; ++j) add(i, j);
    for (size_t i = border; i < size; ++i)
        for (size_t j = border; j < i; ++j) add(i, j);
}

}

DistanceTables::DistanceTables(const Numbering& numbering)
    : border_internal(numbering.border_internal_begin.back(), INFINITE),
      internal(numbering.internal_table_begin.back(), INFINITE) {
    for (uint32_t p = 0; p < numbering.first_leaf(); ++p)
        overlay.emplace_back(size_t{numbering.overlay_size(p)} * numbering.overlay_size(p), INFINITE);
}

void hand_over(DistanceTables tables, const Numbering& numbering, StoredIndex& stored) {
    stored.quantum = smallest_quanta(tables, numbering);
    for (uint32_t p = 0; p < numbering.first_leaf(); ++p) {
        hand_over_overlay(tables.overlay[p], p, numbering, stored);
        tables.overlay[p] = {};
    }
    for (size_t leaf = 0; leaf + 1 < numbering.internal_begin.size(); ++leaf) {
        const float quantum = stored.quantum[numbering.first_leaf() + leaf];
        for (float d : of_leaf(tables.border_internal, numbering.border_internal_begin, leaf))
            stored.border_internal_codes.push_back(TableCode::nearest_to(d, quantum));
        for (float d : of_leaf(tables.internal, numbering.internal_table_begin, leaf))
            stored.internal_codes.push_back(TableCode::nearest_to(d, quantum));
    }
}

}
