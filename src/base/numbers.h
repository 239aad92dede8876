#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace geodesic {

inline constexpr uint32_t NONE = std::numeric_limits<uint32_t>::max(); // no vertex, patch or the like
inline constexpr float INFINITE = std::numeric_limits<float>::infinity();

// The length of a vector in the plane. Unlike std::hypot it gives the same bits everywhere; coordinates are
// those of floats, whose squares no double is too small or too large for.
inline double hypotenuse(double x, double y) { return std::sqrt(x * x + y * y); }

}
