#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>

#include "src/base/array.h"

namespace geodesic {

// The tables that hops read: codes of distances, in steps of the quantum of their patch. Those of two
// vertices on the patch's border are stored in steps of the parent's, and are converted.
//
// Each distance of an inner patch's overlay table lies there twice, in a row of both vertices. A row is in
// two parts: one code for each place of the patch's own ring, and one for each vertex that the patch owns.
// Rows to the ring are those of the border table, for the vertices on the patch's border, and those of the
// inner table, for the vertices that it owns. Rows to owned vertices are those of the owned table, for all
// vertices of the overlay. So a hop up or across reads the rows of a child's border, in which all that it
// leads to lies side by side.
//
// The owned table of a large overlay has each distance once. It is a HalfTable among the owned vertices, and
// rows from the border to these are the columns of the inner table. Hops turn what is missing into rows (see
// TurnedRows).
//
// A leaf has an inner table only, with a row for each of its internal vertices. Hops down read inner tables.
// Beside each row of one lies a row of inner_middles, which has, for each place, the MiddleOffset of the
// segment that begins there.
//
// All codes lie one table kind after the other, so that a mapped file can hold them as they are.
struct HopTables {
    explicit HopTables(std::pmr::memory_resource* memory)
        : border_begin(memory), owned_begin(memory), inner_begin(memory), on_border_begin(memory),
          on_border(memory), made(memory) {}

    Array<uint64_t> border_begin, owned_begin; // per inner patch; leaves have none
    Array<uint64_t> inner_begin;               // per patch
    Array<uint64_t> on_border_begin;           // per patch: where its flags begin in on_border
    // Per position of the overlay of a patch's parent: whether that vertex is on the patch's own border.
    // Eight flags a byte, the first one in the lowest bit.
    Array<uint8_t> on_border;
    std::span<const uint16_t> codes; // those of the following five, in this order; two offsets are a code
    std::span<const uint16_t> border, owned, inner;
    std::span<const uint16_t> internal; // of leaves, below the diagonal, at Numbering::internal_entry()
    std::span<const uint8_t> inner_middles;
    Array<uint16_t> made; // `codes`, unless they lie in a file
};

// The strides of MiddleOffset, of the segments that begin at the places of every ring, and 0 behind the last
// place of each, up to a whole block.
struct MiddleStrides {
    explicit MiddleStrides(std::pmr::memory_resource* memory) : begin(memory), steps(memory) {}

    Array<uint64_t> begin; // per patch
    Array<int16_t> steps;

    const int16_t* of(uint32_t patch) const { return steps.data() + begin[patch]; }
};

// Where the vertex at a position of an overlay is in the two parts of a row.
struct OverlayColumn {
    bool is_owned;
    uint32_t number; // among the owned vertices, or of the own place in the ring
};

// For rows of inner tables along long borders: the least code of each block of PLACES places, those of the
// middles included. A sum of two codes in a block is at least the sum of the least ones, so that most blocks
// of a row need not be read. They follow from the other tables and are in no file.
struct InnerBounds {
    static constexpr size_t PLACES = 16;
    static constexpr size_t FEWEST_PLACES = 224; // shorter borders are read as a whole as quickly

    explicit InnerBounds(std::pmr::memory_resource* memory) : begin(memory), codes(memory) {}

    Array<uint64_t> begin; // per patch: where those of its rows begin in `codes`
    Array<uint16_t> codes;

    static size_t blocks(size_t places) { return (places + PLACES - 1) / PLACES; }
    static bool are_kept(size_t places) { return places >= FEWEST_PLACES; }
};

}
