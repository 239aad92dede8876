#pragma once

#include <span>

#include "src/overlay/inner_sweep.h"
#include "src/overlay/ssad.h"
#include "src/overlay/tables.h"

namespace geodesic {

// The fields of several sources, each by itself, in one sweep down, which reads each table once. Vertices are
// given by their numbers.
class OverlayBatch {
public:
    static constexpr size_t SOURCES = InnerSweep::MOST_SOURCES;

    OverlayBatch(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // distances[number * SOURCES + i] from the i-th source, of which there are 1 to SOURCES, the last one
    // repeated. climber: for the way up.
    void sweep(std::span<const uint32_t> sources, OverlaySsad& climber, std::span<float> distances);

private:
    void mark_patches_around(std::span<const uint32_t> sources);
    void descend(uint32_t patch, std::span<float> distances);

    const OverlayIndex& index_;
    const Numbering& numbering_;
    InnerSweep sweep_;               // of the patch at hand
    Array<float> out_;               // per row, SOURCES each
    Array<uint16_t> sources_inside_; // per patch: a bit each
};

}
