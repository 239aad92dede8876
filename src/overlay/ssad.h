#pragma once

#include <span>

#include "src/overlay/inner_sweep.h"
#include "src/overlay/outer_crossing.h"
#include "src/overlay/tables.h"

namespace geodesic {

// Where a path may cross a border. AT_VERTICES is for measuring what the other one is worth.
enum class Crossing { BETWEEN_VERTICES, AT_VERTICES };

// Single source, all destinations on overlay tables: one sweep up from the source's leaf, one down to all
// leaves. Vertices are given by their numbers.
class OverlaySsad {
public:
    OverlaySsad(const OverlayIndex& index, std::pmr::memory_resource* memory,
                Crossing crossing = Crossing::BETWEEN_VERTICES);

    // Of sweep(); at least 1, which it is at first.
    void set_threads(uint32_t count);

    // distance[number], of every vertex; patches beyond `radius` are left out, and their vertices at
    // infinity.
    void sweep(uint32_t source, float radius, std::span<float> distance);

    // Distances to the borders of all patches on levels 1 to `level`, and to what lies just inside of the
    // patches that the source lies in; the others are infinite.
    void sweep_borders(uint32_t source, uint32_t level, std::span<float> distance);

    // The first half, into a field of infinity: distances to the overlays of all patches that the source lies
    // in.
    void climb(uint32_t source, DistanceField distance);

private:
    RingSegments segments_of(uint32_t patch) const;
    void ascend(uint32_t child, DistanceField distance);
    void descend(uint32_t patch, float radius, std::span<float> distance, InnerSweep& sweep) const;

    const OverlayIndex& index_;
    const Numbering& numbering_;
    Array<float> gaps_; // in the place of all segments, where paths cross at vertices; otherwise empty
    OuterCrossing ascent_;
    Array<InnerSweep> descents_;      // one a thread
    Array<uint8_t> is_around_source_; // per patch
};

}
