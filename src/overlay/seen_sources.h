#pragma once

#include <span>

#include "src/overlay/ring_segments.h"
#include "src/overlay/tables.h"

namespace geodesic {

// The border of one patch after the other, and which of several sources each of its vertices is nearest to.
// The ends of a segment that are nearest to different sources do not tell how far it is from its inside: it
// is a gap.
class SeenSources {
public:
    SeenSources(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // By number, the sources where distances are finite.
    void see(uint32_t patch, const float* distance, const uint32_t* nearest_source);

    bool are_several() const { return are_several_; }
    uint32_t at(size_t place) const { return source_[place]; }
    uint32_t any() const { return any_; } // NONE: the border sees none
    RingSegments segments() const {
        return are_several_ ? RingSegments{length_.data(), half_inverse_.data()} : all_segments_;
    }

private:
    void leave_gaps(uint32_t places);

    const Rings& rings_;
    uint32_t any_ = NONE;
    bool are_several_ = false;
    RingSegments all_segments_{};
    Array<uint32_t> source_;             // per place
    Array<float> length_, half_inverse_; // of several
};

}
