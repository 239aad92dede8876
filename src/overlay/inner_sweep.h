#pragma once

#include <memory_resource>
#include <span>

#include "src/overlay/border_field.h"
#include "src/overlay/kernels/sweep.h"
#include "src/overlay/tables.h"

namespace geodesic {

// From the border of one patch after the other to what lies one hop inside of it, for one source or for
// several at once: distances of a vertex lie side by side, `sources` of them.
class InnerSweep {
public:
    static constexpr size_t MOST_SOURCES = SweepKernel::SOURCES;

    // sources: 1 or MOST_SOURCES.
    InnerSweep(const OverlayIndex& index, size_t sources, std::pmr::memory_resource* memory);

    // From the border of a patch, with distances[number * sources + i] from the i-th source. Returns the
    // least of them, infinity where no source reaches any vertex of the border.
    float see(uint32_t patch, const float* distances) {
        return see(patch, distances, segments_from(rings_, rings_.begin[patch]));
    }
    // Likewise, with other segments, which must outlive the crossing.
    float see(uint32_t patch, const float* distances, const RingSegments& segments);

    // To what lies inside of that patch, if see() returned less than infinity: inside[i * sources + source].
    void cross(float* inside);

    // Likewise, of one source, slower, and over which place of the border: winners of CrossingKernel.
    void cross(float* inside, uint16_t* winners);

    // Those of what lies inside of that patch, until the next patch is seen.
    Rows inner_rows();

private:
    bool see_from(size_t source);
    void cross_near(size_t source, float* inside);

    const OverlayIndex& index_;
    const Numbering& numbering_;
    const Rings& rings_;
    const SweepKernel& kernel_;
    size_t sources_;
    uint32_t patch_ = 0;
    RingSegments segments_{};
    SweptBorder border_{};
    SweptCodes codes_{};
    Array<float> distance_, middle_distance_; // [place * sources + source], as are codes
    Array<int16_t> code_, middle_;
    std::array<float, MOST_SOURCES> nearest_{};
    BorderField field_; // of one source, as are these
    Array<const uint16_t*> rows_;
    Array<float> inside_;
};

}
