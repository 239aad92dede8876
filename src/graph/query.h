#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include "src/graph/arc_queue.h"
#include "src/graph/tables.h"

namespace geodesic {

// Queries by a search over the tables of borders (paper 3.4). Vertices are given by their numbers.
// Sums along a border are doubles: a border has many ways of nearly the same length, and of the sums of
// floats the one with the most hops rounded down would be the least.
class GraphQuery {
public:
    GraphQuery(const GraphIndex& index, std::pmr::memory_resource* memory);

    // Symmetric bit for bit if low < high.
    float sssd(uint32_t low, uint32_t high);

    // From then on prepared_sssd() is from this source; nothing is gained by that.
    void prepare(uint32_t source) { prepared_ = source; }
    float prepared_sssd(uint32_t target) {
        return sssd(std::min(prepared_, target), std::max(prepared_, target));
    }

    // distance[number], of every vertex, whatever the radius.
    void msad(std::span<const uint32_t> sources, float, std::span<float> distance) {
        nearest_sources(sources, distance, {});
    }

    // The same, and fills source[number] with the source that is nearest, NONE for none, unless it is empty.
    void nearest_sources(std::span<const uint32_t> sources, std::span<float> distance,
                         std::span<uint32_t> source);

private:
    // msad.cpp
    void start_from(uint32_t source);
    void start_from_internal(uint32_t source);
    void climb();
    void descend();
    void cross_overlay(uint32_t patch, uint32_t start_count);
    void activate(uint32_t slot);
    uint32_t nearest_active_child(uint32_t patch) const;
    void cross_child(uint32_t patch, uint32_t child);
    void pass_on(uint32_t patch, uint32_t slot, double distance);
    void fill_leaf(uint32_t leaf);

    // nearest_sources.cpp
    void take_way(uint32_t number, float way, uint32_t source);
    void find_crossed_sources(uint32_t child);
    void find_sources_in_leaf(uint32_t leaf);

    // sssd.cpp
    float same_leaf_distance(uint32_t a, uint32_t b) const;
    float common_border_distance(uint32_t low, uint32_t high) const;
    double search(uint32_t source, uint32_t target);
    std::optional<double> search_led(uint32_t source, uint32_t target, uint64_t most_steps);
    double bound(uint32_t a, uint32_t b) const;
    void allow_ancestors(uint32_t source, uint32_t target);
    void open(uint32_t node, double distance, uint32_t target);
    void relax_border_vertex(uint32_t node, double distance, uint32_t target);

    const GraphIndex& index_;
    const Numbering& numbering_;
    uint32_t prepared_ = NONE;
    ArcQueue queue_;         // of SSSD
    double bound_scale_ = 0; // of the index, or 0 for a search by distances alone

    // MSAD: distances by number and the sources that they come from, the caller's; which inner patches have
    // sources below them.
    std::span<float> distance_;
    std::span<uint32_t> source_;
    Array<uint8_t> has_sources_;
    // The overlay that is being crossed: distances per slot, so that a table row meets them side by side; per
    // child the slots whose rows have not been looked at since their distance fell, in the child's part of
    // the array.
    Array<double> slot_distance_;
    Array<uint8_t> slot_is_active_;
    Array<uint32_t> active_slots_;
    Array<uint32_t> active_count_; // per patch
    Array<double> nearest_active_; // per patch: no active slot is nearer; infinity without one
    // Of one child's border, while its rows are looked at: distances, and the sources of those that fell.
    Array<double> crossed_;
    Array<uint32_t> crossed_source_;

    // SSSD: distances of border vertices, valid where the epoch is the current one; likewise allowed patches.
    Array<double> search_distance_;
    Array<uint32_t> search_epoch_, allowed_epoch_;
    uint32_t epoch_ = 0;
    uint32_t top_ = 0; // the first common ancestor of both vertices' patches
};

}
