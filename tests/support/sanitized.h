#pragma once

#include <cstdint>

namespace geodesic::test {

// Whether this is a build with a sanitizer: each query then takes ten times as long, or longer.
#ifdef GEOIDX_SANITIZED
inline constexpr bool SANITIZED = true;
#else
inline constexpr bool SANITIZED = false;
#endif

// The step of a loop that asks the same of many vertices. With a sanitizer it asks every eleventh of them:
// each branch is still taken hundreds of times.
constexpr uint32_t sparse(uint32_t step) { return SANITIZED ? 11 * step : step; }

// The size of a mesh whose index takes long to build. With a sanitizer it is smaller, but still so large that
// the build and the queries take the same branches.
constexpr uint32_t smaller(uint32_t size, uint32_t sanitized_size) {
    return SANITIZED ? sanitized_size : size;
}

}
