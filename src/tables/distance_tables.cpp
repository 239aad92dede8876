#include "src/tables/distance_tables.h"

#include <algorithm>
#include <span>
#include <utility>

#include "src/overlay/tables/codes.h"
#include "src/tables/rounding.h"

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

float longest_of_leaf(uint32_t leaf, const Numbering& numbering, const DistanceTables& tables) {
    const uint32_t i = leaf - numbering.first_leaf();
    return std::max(longest(of_leaf(tables.border_internal, numbering.border_internal_begin, i)),
                    longest(of_leaf(tables.internal, numbering.internal_table_begin, i)));
}

// The longest distance in the tables of the leaves inside of a patch.
float longest_of_leaves_inside(uint32_t patch, const Numbering& numbering, const DistanceTables& tables) {
    uint32_t first = patch, end = patch + 1;
    while (first < numbering.first_leaf()) {
        first = numbering.child_begin[first];
        end = numbering.child_begin[end];
    }
    float longest = 0;
    for (uint32_t leaf = first; leaf < end; ++leaf)
        longest = std::max(longest, longest_of_leaf(leaf, numbering, tables));
    return longest;
}

void add_codes(std::span<const float> distances, const Steps& steps, std::vector<uint16_t>& codes) {
    for (float d : distances) codes.push_back(TableCode::nearest_to(d, steps.quantum, steps.shift));
}

Steps add_steps(Steps steps, StoredIndex& stored) {
    stored.quantum.push_back(steps.quantum);
    stored.shift.push_back(steps.shift);
    return steps;
}

// Adds the codes of owned x border, then those of owned x owned below the diagonal.
void hand_over_overlay(uint32_t patch, const Numbering& numbering, float rounding, DistanceTables& tables,
                       StoredIndex& stored) {
    const std::vector<float> table = std::exchange(tables.overlay[patch], {});
    // Labels count in steps of this quantum, so that it must not be 0 where a table has no distance but 0, as
    // it is if all its borders meet in one vertex.
    const size_t border = numbering.border_size(patch), size = numbering.overlay_size(patch);
    const float own = longest(table);
    const Steps steps = add_steps(
        choose_steps(own > 0 ? own : longest_of_leaves_inside(patch, numbering, tables), rounding), stored);
    for (size_t i = border; i < size; ++i)
        add_codes(std::span(table).subspan(i * size, border), steps, stored.overlay_codes);
    for (size_t i = border; i < size; ++i)
        add_codes(std::span(table).subspan(i * size + border, i - border), steps, stored.overlay_codes);
}

void hand_over_leaf(uint32_t patch, const Numbering& numbering, float rounding, const DistanceTables& tables,
                    StoredIndex& stored) {
    const uint32_t leaf = patch - numbering.first_leaf();
    const auto border_internal = of_leaf(tables.border_internal, numbering.border_internal_begin, leaf);
    const auto internal = of_leaf(tables.internal, numbering.internal_table_begin, leaf);
    const Steps steps = add_steps(choose_steps(longest_of_leaf(patch, numbering, tables), rounding), stored);
    add_codes(border_internal, steps, stored.border_internal_codes);
    add_codes(internal, steps, stored.internal_codes);
}

}

DistanceTables::DistanceTables(const Numbering& numbering)
    : border_internal(numbering.border_internal_begin.back(), INFINITE),
      internal(numbering.internal_table_begin.back(), INFINITE) {
    for (uint32_t p = 0; p < numbering.first_leaf(); ++p)
        overlay.emplace_back(size_t{numbering.overlay_size(p)} * numbering.overlay_size(p), INFINITE);
}

void hand_over(uint32_t patch, const Numbering& numbering, float rounding, DistanceTables& tables,
               StoredIndex& stored) {
    if (patch < numbering.first_leaf())
        hand_over_overlay(patch, numbering, rounding, tables, stored);
    else
        hand_over_leaf(patch, numbering, rounding, tables, stored);
}

}
