#pragma once

#include <cstddef>

namespace geodesic {

// function(i) for 0 .. count - 1, for loops that do so little that counting would be half of it.
template <class Function>
void four_at_a_time(size_t count, const Function& function) {
    size_t i = 0;
    for (; i + 4 <= count; i += 4)
        for (size_t j = 0; j < 4; ++j) function(i + j);
    for (; i < count; ++i) function(i);
}

}
