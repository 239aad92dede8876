#pragma once

#include <limits>

#include "src/overlay/batch.h"
#include "src/overlay/msad.h"
#include "src/overlay/ssad.h"
#include "src/overlay/sssd/sssd.h"

namespace geodesic {

// Queries on overlay tables: fixed sequences of min-plus products. A path may cross a border between two
// vertices where the metric unfolds.
class OverlayQuery {
public:
    OverlayQuery(const OverlayIndex& index, std::pmr::memory_resource* memory)
        : pairs_(index, memory), field_(index, memory), nearest_(index, memory), batch_(index, memory),
          vertex_count_(index.numbering.vertex_count()), prepared_distance_(memory) {}

    // Symmetric bit for bit if low < high.
    float sssd(uint32_t low, uint32_t high) { return pairs_.distance(low, high); }

    // From then on prepared_sssd() is from this source.
    void prepare(uint32_t source) {
        prepared_ = source;
        prepared_distance_.resize(vertex_count_);
        field_.sweep_borders(source, pairs_.prepared_level(), prepared_distance_);
    }
    float prepared_sssd(uint32_t target) {
        return pairs_.distance_from(prepared_, prepared_distance_, target);
    }

    // Of msad().
    void set_threads(uint32_t count) {
        field_.set_threads(count);
        nearest_.set_threads(count);
    }

    // distance[number], of every vertex; those of patches beyond the radius may be infinite.
    void msad(std::span<const uint32_t> sources, float radius, std::span<float> distance) {
        if (sources.size() == 1)
            field_.sweep(sources.front(), radius, distance);
        else
            nearest_.sweep(sources, radius, distance);
    }

    // distances[number * FIELDS_AT_ONCE + i], of each source by itself, of which there are 1 to so many. With
    // fewer than FEWEST_AT_ONCE it is faster to ask for each.
    static constexpr size_t FIELDS_AT_ONCE = OverlayBatch::SOURCES, FEWEST_AT_ONCE = 8;
    void ssad_each(std::span<const uint32_t> sources, std::span<float> distances) {
        batch_.sweep(sources, field_, distances);
    }

private:
    OverlaySssd pairs_;
    OverlaySsad field_;
    OverlayMsad nearest_;
    OverlayBatch batch_;
    size_t vertex_count_;
    uint32_t prepared_ = NONE;
    Array<float> prepared_distance_; // by number: of sweep_borders()
};

}
