#pragma once

#include <cstdint>

namespace geodesic::test {

// Whether this is a build with a sanitizer: each query then takes ten times as long, or longer.
#ifdef GEOIDX_SANITIZED
inline constexpr bool SANITIZED = true;
#else
inline constexpr bool SANITIZED = false;
#endif

// The step of a loop that asks the same of many vertices, or what a number of questions is divided by. With a
// sanitizer it asks every eleventh of them: each branch is still taken hundreds of times.
constexpr uint32_t sparse(uint32_t step) { return SANITIZED ? 11 * step : step; }

// A size of a mesh, or a number of questions, that takes long. With a sanitizer it is smaller, but still so
// large that the same branches are taken.
constexpr uint32_t smaller(uint32_t size, uint32_t sanitized_size) {
    return SANITIZED ? sanitized_size : size;
}

}
