#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "src/index/overlay_tables.h"

namespace geodesic {

// Distances of a source from the places of a border, as codes that kernels add table entries to. They count
// from the nearest place's, which has the smallest number, so that sums fit; a place that is not reached has
// NOT_SEEN, and so have those behind the last up to whole blocks.
struct SeenCodes {
    static constexpr int16_t NEAREST = std::numeric_limits<int16_t>::min(), NOT_SEEN = 0;

    // Sums from here on may be of places that are not seen, or of no way.
    static constexpr int32_t NO_SUM = NEAREST + OverlayTables::UNREACHED;

    // Places are read in so many at once.
    static constexpr size_t BLOCK = 32;
    static constexpr size_t whole_blocks(size_t places) { return (places + BLOCK - 1) / BLOCK * BLOCK; }
    static_assert(OverlayTables::PADDING >= BLOCK && Rings::PADDING >= BLOCK,
                  "the last row of a table is read in whole blocks");
};

}
