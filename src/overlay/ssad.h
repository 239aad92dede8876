#pragma once

#include <span>

#include "src/overlay/inner_sweep.h"
#include "src/overlay/outer_crossing.h"
#include "src/overlay/tables.h"

namespace geodesic {

// Where a path may cross a border. AT_VERTICES serves to measure how much is gained by crossing between
// vertices.
enum class Crossing { BETWEEN_VERTICES, AT_VERTICES };

// Distances from a single source to all destinations over overlay tables, by one sweep up from the source and
// one sweep down to all leaves. Vertices are given by their numbers.
class OverlaySsad {
public:
    OverlaySsad(const OverlayIndex& index, std::pmr::memory_resource* memory,
                Crossing crossing = Crossing::BETWEEN_VERTICES);

    // Sets how many threads sweep() uses, at least 1. It is 1 at first.
    void set_threads(uint32_t count);

    // Fills distance[number] of every vertex. Patches whose whole border is farther than `radius` are
    // skipped, and their vertices stay at infinity.
    void sweep(uint32_t source, float radius, std::span<float> distance);

    // Fills the distances to the borders of all patches on levels 1 to `level`, and to the inner vertices of
    // the patches that contain the source. All others are infinite.
    void sweep_borders(uint32_t source, uint32_t level, std::span<float> distance);

    // The sweep up. It fills the distances to the overlays of all patches that contain the source, in a field
    // that the caller has set to infinity.
    void climb(uint32_t source, DistanceField distance);

private:
    RingSegments segments_of(uint32_t patch) const;
    void ascend(uint32_t child, DistanceField distance);
    void descend(uint32_t patch, float radius, std::span<float> distance, InnerSweep& sweep) const;

    const OverlayIndex& index_;
    const Numbering& numbering_;
    Array<float> gaps_; // gaps that replace all segments with AT_VERTICES; empty otherwise
    OuterCrossing ascent_;
    Array<InnerSweep> descents_;      // one for each thread
    Array<uint8_t> is_around_source_; // per patch
};

}
