#pragma once

#include <memory_resource>

#include "src/overlay/ring_segments.h"
#include "src/overlay/tables.h"

namespace geodesic {

// Finds out which of several sources each vertex of a border is nearest to. Where the two ends of a segment
// are nearest to different sources, their distances do not tell how far either source is from the points
// between them, so that the segment becomes a gap. The object is used for one border after the other.
class BorderSources {
public:
    BorderSources(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // Both arrays are by vertex number. nearest_source is read only where the distance is finite.
    void read(uint32_t patch, const float* distance, const uint32_t* nearest_source);

    bool are_several() const { return are_several_; }
    uint32_t at(size_t place) const { return source_[place]; }
    uint32_t any() const { return any_; } // NONE if no source reaches the border
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
    Array<float> length_, half_inverse_; // used if the border has several nearest sources
};

}
