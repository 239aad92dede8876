#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace geodesic {

// A row of a table and what its entries are added to.
struct MinPlusRow {
    const uint16_t* entries;
    uint16_t start;
};

// Rows are read in blocks of so many columns.
inline constexpr size_t MIN_PLUS_BLOCK = 32;
inline constexpr size_t min_plus_room(size_t columns) {
    return (columns + MIN_PLUS_BLOCK - 1) / MIN_PLUS_BLOCK * MIN_PLUS_BLOCK;
}

// A kernel for one kind of processor.
struct MinPlusKernel {
    const char* name;
    void (*lower)(std::span<const MinPlusRow> rows, size_t room, uint16_t* best, uint16_t* winner);
};

// Those that this processor can run, the fastest last. All give the same bits.
std::span<const MinPlusKernel> min_plus_kernels();

// best[x] = min over the rows of start + entries[x], and winner[x] the first row that attains it, for x in
// 0 .. columns - 1; without rows best is 65535. No sum may exceed 16 bits. entries, best and winner have room
// for min_plus_room(columns).
void min_plus(std::span<const MinPlusRow> rows, size_t columns, uint16_t* best, uint16_t* winner,
              const MinPlusKernel& kernel = min_plus_kernels().back());

}
