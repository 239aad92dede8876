#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "src/overlay/codes.h"

namespace geodesic {

// A ring, and the distances of sources from its places: infinity behind the last one, up to whole blocks.
struct SweptBorder {
    size_t places;
    const float* distance;
    const float* length; // of the segment to the next place; NaN: a gap
    float quantum;       // of the rows
};

// The distances as codes of SourceCode, from the places and from the middles of the segments that begin at
// them.
struct SweptCodes {
    int16_t *code, *middle;
    float* nearest; // per source; infinity: none is reached, and its codes say nothing
};

// Rows of codes, end to end: one a place, and one a segment's middle.
struct SweptRows {
    size_t count;
    const uint16_t *codes, *middles;
};

// For one kind of processor. A sweep is the innermost loop of MSAD: from a border to all that lies one hop
// inside of it, over places and middles.
struct SweepKernel {
    // Of several sources, everything of a place or a row lies side by side.
    static constexpr size_t SOURCES = 16;

    const char* name;

    // Fills codes, with room for whole blocks; middle_distance: as much room, for what it computes.
    void (*see)(const SweptBorder& border, const SweptCodes& codes, float* middle_distance);
    void (*see_each)(const SweptBorder& border, const SweptCodes& codes, float* middle_distance);

    // distances[row]: the least way over any place or middle, or infinity; of each: distances[row * SOURCES +
    // source].
    void (*sweep)(const SweptBorder& border, const SweptCodes& codes, const SweptRows& rows,
                  float* distances);
    void (*sweep_each)(const SweptBorder& border, const SweptCodes& codes, const SweptRows& rows,
                       float* distances);
};

// Those that this processor can run, the fastest last. All give the same bits, and for each of several
// sources the same as for one alone.
std::span<const SweepKernel> sweep_kernels();

}
