#include <algorithm>
#include <experimental/simd>

#include "src/graph/query.h"

namespace geodesic {

namespace {

namespace simd = std::experimental;
// distances[i] = min(distances[i], d + row[i]): one step of a min-plus product.
template <class Number>
void add_row(Number d, std::span<const float> row, Number* distances) {
    using Numbers = simd::native_simd<Number>;
    size_t i = 0;
    for (; i + Numbers::size() <= row.size(); i += Numbers::size()) {
        const Numbers through = d + Numbers(row.data() + i, simd::element_aligned);
        simd::min(through, Numbers(distances + i, simd::element_aligned))
            .copy_to(distances + i, simd::element_aligned);
    }
    for (; i < row.size(); ++i) distances[i] = std::min(distances[i], d + Number{row[i]});
}

}

// First the overlays above the sources, upwards, so that every border of theirs knows its distance; then all
// overlays downwards from their outer borders; then the leaves.
void GraphQuery::nearest_sources(std::span<const uint32_t> sources, std::span<float> distance,
                                 std::span<uint32_t> source) {
    distance_ = distance;
    source_ = source;
    std::fill(distance_.begin(), distance_.end(), INFINITE);
    std::fill(source_.begin(), source_.end(), NONE);
    std::fill(has_sources_.begin(), has_sources_.end(), uint8_t{0});
    for (uint32_t source : sources) start_from(source);
    climb();
    descend();
    for (uint32_t leaf = numbering_.first_leaf(); leaf < numbering_.patch_count(); ++leaf) fill_leaf(leaf);
}

void GraphQuery::start_from(uint32_t source) {
    take_way(source, 0, source);
    if (numbering_.is_border(source))
        has_sources_[numbering_.owner[source]] = 1;
    else
        start_from_internal(source);
}

void GraphQuery::start_from_internal(uint32_t source) {
    const uint32_t leaf = numbering_.leaf_of(source);
    const uint32_t first = numbering_.first_internal(leaf), own = source - first;
    const auto border = numbering_.border_of(leaf);
    for (uint32_t i = 0; i < border.size(); ++i)
        take_way(border[i], index_.border_internal_row(leaf, i)[own], source);
    for (uint32_t i = 0; i < numbering_.internal_size(leaf); ++i)
        take_way(first + i, index_.internal_distance(leaf, own, i), source);
    has_sources_[numbering_.parent[leaf]] = 1;
}

void GraphQuery::climb() {
    for (uint32_t p = numbering_.first_leaf(); p-- > 0;) {
        if (!has_sources_[p]) continue;
        cross_overlay(p, numbering_.overlay_size(p));
        if (p > 0) has_sources_[numbering_.parent[p]] = 1;
    }
}

void GraphQuery::descend() {
    for (uint32_t p = 1; p < numbering_.first_leaf(); ++p) cross_overlay(p, numbering_.border_size(p));
}

// Shortest paths over the tables of a patch's children, from the first start_count overlay positions.
// Children take turns, the one with the nearest active slot next; whole rows are read side by side, which
// outweighs that a distance may fall again later.
void GraphQuery::cross_overlay(uint32_t patch, uint32_t start_count) {
    const uint32_t first = numbering_.border_begin[numbering_.child_begin[patch]];
    const uint32_t last = numbering_.border_begin[numbering_.child_begin[patch + 1]];
    for (uint32_t slot = first; slot < last; ++slot) {
        slot_distance_[slot] = double{distance_[numbering_.border[slot]]};
        if (numbering_.overlay_position[slot] < start_count && slot_distance_[slot] < INFINITE)
            activate(slot);
    }
    for (uint32_t child; (child = nearest_active_child(patch)) != NONE;) cross_child(patch, child);
    for (uint32_t slot = first; slot < last; ++slot)
        distance_[numbering_.border[slot]] = static_cast<float>(slot_distance_[slot]);
}

void GraphQuery::activate(uint32_t slot) {
    const uint32_t child = index_.slots.patch_of_slot[slot];
    nearest_active_[child] = std::min(nearest_active_[child], slot_distance_[slot]);
    if (slot_is_active_[slot]) return;
    slot_is_active_[slot] = 1;
    active_slots_[numbering_.border_begin[child] + active_count_[child]++] = slot;
}

uint32_t GraphQuery::nearest_active_child(uint32_t patch) const {
    uint32_t nearest = NONE;
    double smallest = INFINITE;
    for (uint32_t child = numbering_.child_begin[patch]; child < numbering_.child_begin[patch + 1]; ++child)
        if (nearest_active_[child] < smallest) {
            smallest = nearest_active_[child];
            nearest = child;
        }
    return nearest;
}

// Tables hold whole-surface distances, so a distance that fell over a child's table needs not cross it again:
// only the other children's slots of that vertex become active.
void GraphQuery::cross_child(uint32_t patch, uint32_t child) {
    const uint32_t first = numbering_.border_begin[child], size = numbering_.border_size(child);
    std::copy_n(slot_distance_.begin() + first, size, crossed_.begin());
    for (uint32_t i = 0; i < active_count_[child]; ++i) {
        const uint32_t slot = active_slots_[first + i];
        slot_is_active_[slot] = 0;
        add_row(slot_distance_[slot], {index_.border_row(child, slot - first), size}, crossed_.data());
    }
    if (!source_.empty()) find_crossed_sources(child);
    active_count_[child] = 0;
    nearest_active_[child] = INFINITE;
    for (uint32_t k = 0; k < size; ++k) {
        if (!(crossed_[k] < slot_distance_[first + k])) continue;
        if (!source_.empty()) source_[numbering_.border[first + k]] = crossed_source_[k];
        pass_on(patch, first + k, crossed_[k]);
    }
}

void GraphQuery::pass_on(uint32_t patch, uint32_t slot, double distance) {
    for (uint32_t copy : index_.slots.of(patch, numbering_.overlay_position[slot])) {
        slot_distance_[copy] = distance;
        if (copy != slot) activate(copy);
    }
}

void GraphQuery::fill_leaf(uint32_t leaf) {
    const auto border = numbering_.border_of(leaf);
    const uint32_t size = numbering_.internal_size(leaf);
    for (uint32_t b = 0; b < border.size(); ++b)
        add_row(distance_[border[b]], {index_.border_internal_row(leaf, b), size},
                distance_.data() + numbering_.first_internal(leaf));
    if (!source_.empty()) find_sources_in_leaf(leaf);
}

}
