#pragma once

#include <cstddef>

#include "src/index/unfolding.h"

namespace geodesic {

// function(i) for 0 .. count - 1, for loops that do so little that counting would be half of it.
template <class Function>
void four_at_a_time(size_t count, const Function& function) {
    size_t i = 0;
    for (; i + 4 <= count; i += 4)
        for (size_t j = 0; j < 4; ++j) function(i + j);
    for (; i < count; ++i) function(i);
}

// Rows become columns.
inline void transpose(NearFloats four[4]) {
    const NearFloats low_01 = __builtin_shufflevector(four[0], four[1], 0, 4, 1, 5);
    const NearFloats low_23 = __builtin_shufflevector(four[2], four[3], 0, 4, 1, 5);
    const NearFloats high_01 = __builtin_shufflevector(four[0], four[1], 2, 6, 3, 7);
    const NearFloats high_23 = __builtin_shufflevector(four[2], four[3], 2, 6, 3, 7);
    four[0] = __builtin_shufflevector(low_01, low_23, 0, 1, 4, 5);
    four[1] = __builtin_shufflevector(low_01, low_23, 2, 3, 6, 7);
    four[2] = __builtin_shufflevector(high_01, high_23, 0, 1, 4, 5);
    four[3] = __builtin_shufflevector(high_01, high_23, 2, 3, 6, 7);
}

}
