#pragma once

#include <cstdint>
#include <limits>

namespace geodesic {

inline constexpr uint32_t NONE = std::numeric_limits<uint32_t>::max(); // no vertex, patch or the like
inline constexpr float INFINITE = std::numeric_limits<float>::infinity();

}
