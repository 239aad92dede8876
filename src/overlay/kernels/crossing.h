#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "src/overlay/codes.h"

namespace geodesic {

// The border of a patch as seen from a source, by the places of its ring: what a kernel reads.
struct SeenBorder {
    static constexpr uint16_t NO_PLACE = 0xffff; // a winner where there is no way

    size_t places;
    const int16_t* code;                // of SourceCode
    const float* distance;              // infinity behind the last place, too, up to whole blocks
    const float *length, *half_inverse; // of the segment to the next place; NaN: a gap
    const float *foot, *height;         // of the source, seen from the segment
    float quantum;                      // of the rows
};

// How a border is seen.
struct Sight {
    float nearest;      // the distance of the nearest place
    float reach;        // up to which a distance is near
    size_t first, last; // near places, and those between them; none if first > last
    bool is_near() const { return first <= last; }
};

// Rows of a table, each one code a place.
using Rows = std::span<const uint16_t* const>;

// For one kind of processor.
struct CrossingKernel {
    const char* name;

    // Fills code, foot and height, which are the border's own, from the rest of it; codes only where is_own
    // is -1, not 0. If the nearest place is at infinity, it fills nothing.
    Sight (*see)(const SeenBorder& border, const int32_t* is_own, int16_t* code, float* foot, float* height);

    // distances[r]: the least way over a place and row r, straightened over the segments near the place where
    // that is shorter, or infinity; winners[r], if not NULL: that place, or NO_PLACE.
    void (*cross)(const SeenBorder& border, Rows rows, float* distances, uint16_t* winners);

    // distances[r], where it is near: the least way over row r and a near place, or straightened over any
    // segment that is near. Where a border is jagged, the straight way does not always pass near the place
    // with the least sum.
    void (*cross_near)(const SeenBorder& border, const Sight& sight, Rows rows, float* distances);

    // winners[r]: the place with the least sum of codes, or NO_PLACE; reads no more of the border than these.
    void (*choose)(const SeenBorder& border, Rows rows, uint16_t* winners);
};

// Those that this processor can run, the fastest last. All give the same bits.
std::span<const CrossingKernel> crossing_kernels();

}
