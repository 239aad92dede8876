#pragma once

#include <span>

#include "src/index/index.h"
#include "src/index/unfolding.h"
#include "src/query/min_plus.h"

namespace geodesic {

// Queries on overlay tables: a fixed sequence of min-plus products, up from the leaves of the sources and
// down to those of the targets. A path may cross a border between two vertices where the metric unfolds.
// Vertices are given by their numbers.
class OverlayQuery {
public:
    OverlayQuery(const Index& index, std::pmr::memory_resource* memory);

    // Symmetric bit for bit if low < high.
    float sssd(uint32_t low, uint32_t high);

    // distance[number], of every vertex.
    void msad(std::span<const uint32_t> sources, std::span<float> distance);

private:
    // How far up one end of an SSSD query has come: to the border of `patch`, or, where the vertex itself is
    // in the overlay of `patch`, to its `position` there.
    struct Climber {
        explicit Climber(std::pmr::memory_resource* memory) : distance(memory) {}
        uint32_t patch = 0;
        uint32_t position = NONE;
        Array<float> distance; // per position of the border
    };

    // A border vertex that wins columns, with what straightens the ways over it.
    struct Gate {
        UnfoldedSegments segments;
        const uint16_t* rows[5]; // of the vertex in the middle and its neighbours
        float distance;
        bool is_open = false;
    };

    void take_rows(const uint16_t* first, size_t stride, size_t count);
    void take_rows_of_child(uint32_t child, uint32_t first_column);
    std::span<float> hop(uint32_t border_patch, std::span<const float> distance, float quantum,
                         size_t first_column, size_t columns);
    std::span<float> hop_to_parent(uint32_t child, std::span<const float> distance, bool to_owned);
    void activate_rows(std::span<const float> distance, float quantum);
    void open(Gate& gate, uint32_t border_patch, std::span<const float> distance, uint32_t position);
    static float through(const Gate& gate, float quantum, size_t column);

    // MSAD
    void start_from(uint32_t source, std::span<float> distance);
    void ascend(uint32_t child, std::span<float> distance);
    void descend(uint32_t patch, std::span<float> distance);
    void fill_leaf(uint32_t leaf, std::span<float> distance);
    std::span<const float> distances_of_border(uint32_t patch, std::span<const float> distance);

    // SSSD
    void climb(uint32_t vertex, uint32_t top, Climber& climber);
    void climb_over(uint32_t parent, Climber& climber);
    float meet(uint32_t top, const Climber& from, const Climber& to);
    float meet_at_border(uint32_t patch, std::span<const float> from, std::span<const float> to);

    const Index& index_;
    const OverlayTables& tables_;

    // Of the hop at hand.
    Array<const uint16_t*> rows_; // per border position
    Array<MinPlusRow> active_rows_;
    Array<uint32_t> active_positions_;
    Array<uint16_t> best_, winner_;      // per column
    Array<Gate> gates_;                  // per active row
    Array<float> out_, border_distance_; // per column, per border position

    Array<uint32_t> sources_below_; // per patch, of MSAD
    Climber from_, to_;             // of SSSD
};

}
