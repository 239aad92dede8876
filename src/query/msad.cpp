#include <algorithm>
#include <experimental/simd>
#include <limits>
#include <string>

#include "format/error.h"
#include "src/query/query.h"

namespace geodesic {

namespace {

namespace simd = std::experimental;
using Floats = simd::native_simd<float>;
constexpr auto WIDTH = static_cast<uint32_t>(Floats::size());

constexpr float INFINITE = std::numeric_limits<float>::infinity();

}

uint32_t Query::number_of(uint32_t id) const {
    if (id >= index_.id_count)
        throw Error(GEOIDX_ERROR_INVALID_ARGUMENT, "vertex " + std::to_string(id) +
                                                       " is out of range: the mesh has " +
                                                       std::to_string(index_.id_count) + " vertices");
    return index_.number_of_id[id];
}

// First the overlays above the sources, upwards, so that every border of theirs knows its distance; then all
// overlays downwards from their outer borders; then the leaves.
void Query::msad(std::span<const uint32_t> source_ids, std::span<float> distances) {
    if (distances.size() != index_.id_count)
        throw Error(GEOIDX_ERROR_INVALID_ARGUMENT, "distance_count is " + std::to_string(distances.size()) +
                                                       ", but the mesh has " +
                                                       std::to_string(index_.id_count) + " vertices");
    if (source_ids.empty()) throw Error(GEOIDX_ERROR_INVALID_ARGUMENT, "there is no source");
    std::fill(distance_.begin(), distance_.end(), INFINITE);
    std::fill(has_sources_.begin(), has_sources_.end(), uint8_t{0});
    for (uint32_t id : source_ids)
        if (const uint32_t source = number_of(id); source != NONE) start_from(source);
    climb();
    descend();
    for (uint32_t leaf = index_.first_leaf(); leaf < index_.patch_count(); ++leaf) fill_leaf(leaf);
    for (size_t id = 0; id < distances.size(); ++id) {
        const uint32_t number = index_.number_of_id[id];
        distances[id] = number == NONE ? INFINITE : distance_[number];
    }
    for (uint32_t id : source_ids) distances[id] = 0; // also a source that no triangle uses
}

void Query::start_from(uint32_t source) {
    distance_[source] = 0;
    if (index_.is_border(source))
        has_sources_[index_.owner[source]] = 1;
    else
        start_from_internal(source);
}

void Query::start_from_internal(uint32_t source) {
    const uint32_t leaf = index_.leaf_of(source);
    const uint32_t first = index_.first_internal(leaf), own = source - first;
    const auto border = index_.border_of(leaf);
    for (uint32_t i = 0; i < border.size(); ++i)
        distance_[border[i]] = std::min(distance_[border[i]], index_.crossing_row(leaf, i)[own]);
    for (uint32_t i = 0; i < index_.internal_size(leaf); ++i)
        distance_[first + i] = std::min(distance_[first + i], index_.internal_distance(leaf, own, i));
    has_sources_[index_.parent[leaf]] = 1;
}

void Query::climb() {
    for (uint32_t p = index_.first_leaf(); p-- > 0;) {
        if (!has_sources_[p]) continue;
        cross_overlay(p, index_.overlay_size(p));
        if (p > 0) has_sources_[index_.parent[p]] = 1;
    }
}

void Query::descend() {
    for (uint32_t p = 1; p < index_.first_leaf(); ++p) cross_overlay(p, index_.border_size(p));
}

// Fills the overlay with the distances known so far and queues the first start_count positions of it.
void Query::load_overlay(uint32_t patch, uint32_t start_count) {
    const auto outer = index_.border_of(patch);
    const auto outer_size = static_cast<uint32_t>(outer.size());
    float smallest = INFINITE, largest = 0;
    for (uint32_t i = 0; i < index_.overlay_size(patch); ++i) {
        const uint32_t number = i < outer_size ? outer[i] : index_.owned_begin[patch] + i - outer_size;
        const float d = distance_[number];
        overlay_[i] = {d, INFINITE, NONE, number};
        if (i < start_count && d < INFINITE) {
            smallest = std::min(smallest, d);
            largest = std::max(largest, d);
        }
    }
    const uint32_t first_slot = index_.border_begin[index_.child_begin[patch]];
    const uint32_t last_slot = index_.border_begin[index_.child_begin[patch + 1]];
    for (uint32_t slot = first_slot; slot < last_slot; ++slot)
        slot_distance_[slot] = overlay_[index_.overlay_position[slot]].distance;
    const Index::Reach& reach = index_.reach[patch];
    buckets_.begin(smallest, largest - smallest + reach.longest, reach.step);
    for (uint32_t i = 0; i < start_count; ++i)
        if (overlay_[i].distance < INFINITE) buckets_.push(overlay_[i].distance, i);
}

// Dijkstra over the tables of a patch's children, from the first start_count overlay positions. Tables hold
// whole-surface distances, so a distance that came over a child's table needs not cross it again.
void Query::cross_overlay(uint32_t patch, uint32_t start_count) {
    load_overlay(patch, start_count);
    for (auto step = buckets_.pop_step(); !step.empty(); step = buckets_.pop_step()) {
        for (uint32_t i : step) fetch_rows(patch, i);
        for (uint32_t i : step) {
            OverlayNode& node = overlay_[i];
            if (node.distance == node.crossed_distance) continue;
            node.crossed_distance = node.distance;
            for (uint32_t slot : index_.slots_of(patch, i))
                if (index_.patch_of_slot[slot] != node.arrival) cross_child(patch, slot);
        }
    }
    for (uint32_t i = 0; i < index_.overlay_size(patch); ++i)
        distance_[overlay_[i].number] = overlay_[i].distance;
}

// Asks for the table rows of an overlay position before they are needed: reading them is mostly waiting for
// memory.
void Query::fetch_rows(uint32_t patch, uint32_t overlay_position) const {
    constexpr uint32_t FLOATS_PER_LINE = 16;
    for (uint32_t slot : index_.slots_of(patch, overlay_position)) {
        const uint32_t child = index_.patch_of_slot[slot];
        if (child == overlay_[overlay_position].arrival) continue;
        const float* row = index_.border_row(child, slot - index_.border_begin[child]);
        for (uint32_t k = 0; k < index_.border_size(child); k += FLOATS_PER_LINE) __builtin_prefetch(row + k);
    }
}

// Almost no entry of a row lowers anything: entries are looked at singly only where one of a few side by side
// does.
void Query::cross_child(uint32_t patch, uint32_t slot) {
    const uint32_t child = index_.patch_of_slot[slot];
    const uint32_t first = index_.border_begin[child], size = index_.border_size(child);
    const float d = slot_distance_[slot];
    const float* row = index_.border_row(child, slot - first);
    const float* known = slot_distance_.data() + first;
    uint32_t k = 0;
    for (; k + WIDTH <= size; k += WIDTH) {
        const Floats through = d + Floats(row + k, simd::element_aligned);
        if (simd::none_of(through < Floats(known + k, simd::element_aligned))) continue;
        for (uint32_t j = k; j < k + WIDTH; ++j)
            if (d + row[j] < known[j]) lower(patch, first + j, d + row[j]);
    }
    for (; k < size; ++k)
        if (d + row[k] < known[k]) lower(patch, first + k, d + row[k]);
}

void Query::lower(uint32_t patch, uint32_t slot, float distance) {
    const uint32_t position = index_.overlay_position[slot];
    overlay_[position].distance = distance;
    overlay_[position].arrival = index_.patch_of_slot[slot];
    for (uint32_t copy : index_.slots_of(patch, position)) slot_distance_[copy] = distance;
    buckets_.push(distance, position);
}

void Query::fill_leaf(uint32_t leaf) {
    const auto border = index_.border_of(leaf);
    const uint32_t size = index_.internal_size(leaf);
    float* internal = distance_.data() + index_.first_internal(leaf);
    for (uint32_t b = 0; b < border.size(); ++b) {
        const float d = distance_[border[b]];
        const float* row = index_.crossing_row(leaf, b);
        for (uint32_t i = 0; i < size; ++i) internal[i] = std::min(internal[i], d + row[i]);
    }
}

}
