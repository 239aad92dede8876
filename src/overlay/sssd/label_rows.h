#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>

#include "src/base/array.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// The row of a label in memory: the code of a distance to each place of a ring, in little more than one byte
// a place. Along a chain, the distances of a vertex from two neighbouring places differ by no more than the
// segment between them is long. So a row holds the codes of a few places in full; each other place has one
// byte, the difference from the code before.
//
// A *run* is a sequence of places of a ring whose first one has a code of two bytes. It ends with its chain
// or bridge, and before a place that a long segment leads to. A row begins with the codes of all runs. Then
// comes a byte with a sign for each place of the ring, the steps from the place before; 0 where a run begins.
// Where every place is a run by itself, there are the codes alone.
//
// At most one segment in 16 of a border is long. The quantum of a label is chosen so that the longest of the
// others spans 124 steps.

// Adds the first place of each run of a patch's border, counted from the first one of its ring. Returns the
// quantum with which the longest segment that is not long spans 124 steps; 0 if there are no segments.
float find_runs(const Rings& rings, uint32_t patch, Array<uint16_t>& runs);

// In bytes. With the runs that find_runs() finds this is less than two bytes for a place of a chain: one of
// five places or more has one run, and one in 16 of its segments, three where they are repeated, has another.
// A bridge has two bytes for each of its places, or three if it is long.
inline size_t label_row_size(size_t places, size_t runs) {
    return runs * sizeof(uint16_t) + (runs < places ? places : 0);
}

// Of a ring's codes and runs, of which the first one begins at its first place. Steps that do not fit into a
// byte are made as large as fits, and those after them lead back to the codes. A run that has places with a
// path and places without, which only a file that lies can have, is written as one without.
void write_label_row(std::span<const uint16_t> codes, std::span<const uint16_t> runs, uint8_t* row);

// Reads the codes of so many places. Up to LABEL_ROW_PADDING bytes behind the row are read, and as many codes
// behind the last one are written.
constexpr size_t LABEL_ROW_PADDING = 7;
void read_label_row(const uint8_t* row, std::span<const uint16_t> runs, size_t places, uint16_t* codes);

}
