#include <algorithm>
#include <limits>
#include <string>

#include "format/error.h"
#include "src/query/query.h"

namespace geodesic {

namespace {

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
        cross_overlay(p, 0, index_.overlay_size(p));
        if (p > 0) has_sources_[index_.parent[p]] = 1;
    }
}

void Query::descend() {
    for (uint32_t p = 1; p < index_.first_leaf(); ++p) cross_overlay(p, 0, index_.border_size(p));
}

// Dijkstra over the tables of a patch's children, from the overlay positions [first, last) that have a
// distance. Tables hold whole-surface distances, so a distance that came over a child's table needs not cross
// it again.
void Query::cross_overlay(uint32_t patch, uint32_t first_position, uint32_t last_position) {
    const auto outer = index_.border_of(patch);
    const auto outer_size = static_cast<uint32_t>(outer.size());
    const uint32_t size = index_.overlay_size(patch), owned = index_.owned_begin[patch];
    for (uint32_t i = 0; i < size; ++i) {
        overlay_node_[i] = i < outer_size ? outer[i] : owned + i - outer_size;
        overlay_distance_[i] = distance_[overlay_node_[i]];
    }
    std::fill_n(overlay_arrival_.begin(), size, NONE);
    queue_.clear();
    for (uint32_t i = first_position; i < last_position; ++i)
        if (overlay_distance_[i] < INFINITE) queue_.push(overlay_distance_[i], i);
    while (!queue_.empty()) {
        const auto [d, position] = queue_.pop();
        if (d > overlay_distance_[position]) continue;
        for (const BorderPlace& place : index_.places_of(overlay_node_[position])) {
            const uint32_t child = place.patch;
            if (index_.parent[child] != patch || overlay_arrival_[position] == child) continue;
            const float* row = index_.border_row(child, place.position);
            const uint32_t* to = index_.overlay_position.data() + index_.border_begin[child];
            for (uint32_t k = 0; k < index_.border_size(child); ++k) {
                const float through = d + row[k];
                if (!(through < overlay_distance_[to[k]])) continue;
                overlay_distance_[to[k]] = through;
                overlay_arrival_[to[k]] = child;
                queue_.push(through, to[k]);
            }
        }
    }
    for (uint32_t i = 0; i < size; ++i) distance_[overlay_node_[i]] = overlay_distance_[i];
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
