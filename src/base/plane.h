#pragma once

#include <cmath>

namespace geodesic {

// The length of a vector in the plane. Unlike std::hypot it gives the same bits everywhere; coordinates are
// those of floats, whose squares no double is too small or too large for.
inline double hypotenuse(double x, double y) { return std::sqrt(x * x + y * y); }

// By distances from both ends of a line, a point has a height over the line whose square is this share of the
// square of the line's length, or more. Where distances are rounded, the square of a point on the line may
// come out so far below 0.
inline constexpr float LEAST_SQUARE = -1.f / 32;

// How far along a line the foot of a point is, by the point's distances from the line's first and second end.
inline double foot_of(double length, double from_first, double from_second) {
    return (from_first - from_second) * (from_first + from_second) / (2 * length) + length / 2;
}

}
