#pragma once

#include "src/overlay/tables/tables.h"

namespace geodesic {

// The segment from each place of a ring, or of a part of one, to the next place: its length and 0.5 / length.
// Both are NaN where there is a gap.
struct RingSegments {
    const float *length, *half_inverse;
};

inline RingSegments segments_from(const Rings& rings, size_t first_place) {
    return {rings.segment_length.data() + first_place, rings.half_inverse.data() + first_place};
}

}
