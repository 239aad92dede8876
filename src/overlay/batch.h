#pragma once

#include <span>

#include "src/overlay/inner_sweep.h"
#include "src/overlay/ssad.h"
#include "src/overlay/tables.h"

namespace geodesic {

// The distance fields of several sources, each by itself. They share one sweep down, which reads each table
// once. Vertices are given by their numbers.
class OverlayBatch {
public:
    static constexpr size_t SOURCES = InnerSweep::MOST_SOURCES;

    OverlayBatch(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // Fills distances[number * SOURCES + i] with the distance from the i-th source. There are 1 to SOURCES
    // sources; if there are fewer, the last one is repeated. `climber` does the sweeps up.
    void sweep(std::span<const uint32_t> sources, OverlaySsad& climber, std::span<float> distances);

private:
    void mark_patches_around(std::span<const uint32_t> sources);
    void descend(uint32_t patch, std::span<float> distances);

    const Numbering& numbering_;
    InnerSweep sweep_;               // of the current patch
    Array<float> out_;               // SOURCES distances for each row
    Array<uint16_t> sources_inside_; // per patch: bit i is set if it contains the i-th source
};

}
