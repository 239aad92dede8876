#pragma once

#include <cstdint>

namespace geodesic {

// A table of the distances among some vertices that keeps nearly each of them once: a row has the
// entries up to its own, and is filled up to a multiple of SIDE. So the table consists of squares of SIDE
// rows and columns, and the entries that a row lacks are those of its column in squares farther down.
struct HalfTable {
    static constexpr uint32_t SIDE = 8;

    static constexpr uint32_t columns(uint32_t row) { return row / SIDE * SIDE + SIDE; }
    static constexpr uint64_t row_begin(uint32_t row) {
        const uint64_t above = row / SIDE; // squares
        return SIDE * (above + 1) * (SIDE / 2 * above + row % SIDE);
    }
    static constexpr uint64_t size(uint32_t rows) { return row_begin(rows); }
    static constexpr uint64_t entry(uint32_t i, uint32_t j) {
        return j <= i ? row_begin(i) + j : row_begin(j) + i;
    }
};

}
