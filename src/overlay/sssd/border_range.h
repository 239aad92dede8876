#pragma once

#include <cstdint>
#include <span>

#include "src/overlay/tables.h"

namespace geodesic {

// The part of a border that a path may cross: consecutive places of the border's ring, counted over all
// rings.
struct BorderRange {
    uint32_t first, last;

    uint32_t size() const { return last - first + 1; }
    bool covers(const BorderRange& other) const { return first <= other.first && other.last <= last; }
};

// The whole border of a patch, which must not be empty.
BorderRange whole_border(const OverlayIndex& index, uint32_t patch);

// The part of a border between the samples whose value is at most `limit`, from the sample before the first
// one to the one after the last; the whole border if there is none.
BorderRange range_within(const OverlayIndex& index, uint32_t patch, std::span<const float> values,
                         float limit);

// The lengths of the ways over a sample of a border and over its two neighbours, infinite if there is none.
struct WaysNearSample {
    float over_previous, over_sample, over_next;
};

// A few places on each side of where the shortest way near a sample crosses the border, as these lengths
// show.
BorderRange range_near(const OverlayIndex& index, uint32_t patch, uint32_t sample,
                       const WaysNearSample& ways);

// Where a shorter way may cross a border than the one that was measured over `range` and crosses at `place`:
// the same range, unless that place is at an end of it and other places of the border lie beyond.
BorderRange range_beside(const OverlayIndex& index, uint32_t patch, BorderRange range, uint32_t place);

}
