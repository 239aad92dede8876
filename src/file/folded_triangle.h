#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace geodesic {

// The entries below the diagonal of a symmetric matrix of `size` rows, folded into a rectangle without a gap,
// as the file stores them. Line r of the rectangle is row size - 1 - r of the matrix, followed by row r if
// the size is even, or by row r + 1 if it is odd.
struct FoldedShape {
    uint32_t rows, cols;
};

inline FoldedShape folded_shape(uint32_t size) {
    if (size < 2) return {0, 0};
    return {size / 2, size - 1 + size % 2};
}

// Calls entry(i, j), with i > j, for each entry in the order of the folded rectangle.
template <class Entry>
void for_each_folded(uint32_t size, const Entry& entry) {
    for (uint32_t r = 0; r < folded_shape(size).rows; ++r) {
        const uint32_t upper = size - 1 - r, lower = r + size % 2;
        for (uint32_t j = 0; j < upper; ++j) entry(upper, j);
        for (uint32_t j = 0; j < lower; ++j) entry(lower, j);
    }
}

}
