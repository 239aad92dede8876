#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>

#include "src/base/array.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// The row of a label in memory: the code of a distance to each place of a ring, in little more than one byte
// a place. Along a chain of a border, distances from a vertex change by no more than the lengths of segments,
// so a row holds the codes of a few places, and of all others by how many steps they differ from the code
// before.
//
// A *run* is a sequence of places of a ring whose first one has a code of two bytes. It ends with its chain,
// and before a place that a long segment leads to. A row begins with the codes of all runs. Then comes a byte
// with a sign for each place of the ring, the steps from the place before; 0 where a run begins. Where every
// place is a run by itself, there are the codes alone.

// Adds the first place of each run of a patch's border, counted from the first one of its ring. Returns the
// least quantum with which the steps along all segments but long ones fit into a byte.
float find_runs(const Rings& rings, uint32_t patch, Array<uint16_t>& runs);

// In bytes.
inline size_t label_row_size(size_t places, size_t runs) {
    return runs * sizeof(uint16_t) + (runs < places ? places : 0);
}

// Steps that do not fit into a byte are made as large as fits, and those after them lead back to the codes.
void write_label_row(std::span<const uint16_t> codes, std::span<const uint16_t> runs, uint8_t* row);

// Reads the codes of so many places. Up to LABEL_ROW_PADDING bytes behind the row are read, and as many codes
// behind the last one are written.
constexpr size_t LABEL_ROW_PADDING = 7;
void read_label_row(const uint8_t* row, std::span<const uint16_t> runs, size_t places, uint16_t* codes);

}
