#include "src/index/face_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geodesic {

namespace {

// The straight way over edge k, or infinity where the line does not cross it, or where distances from its
// ends place the vertex nowhere (see mend_square in src/overlay/unfolding.h).
double straight_over(const FacePoint& point, size_t k, double from_first, double from_second) {
    constexpr double NO_WAY = std::numeric_limits<double>::infinity();
    const double length = point.edge_length[k];
    if (!(length > 0)) return NO_WAY;
    const double foot = (from_first - from_second) * (from_first + from_second) / (2 * length) + length / 2;
    const double square = (from_first - foot) * (from_first + foot);
    if (!(square >= length * length / -32)) return NO_WAY;
    const double height = std::sqrt(std::max(square, 0.0)), off = point.height[k] + height;
    const double crossing = point.foot[k] * height + foot * point.height[k];
    if (!(crossing > 0 && crossing < length * off)) return NO_WAY;
    return std::hypot(point.foot[k] - foot, off);
}

}

// The position follows from the weights alone: the origin is the first end of the edge.
FacePoint face_point(const std::array<uint32_t, 3>& corners, const std::array<double, 3>& edge_length,
                     const std::array<double, 3>& weights, bool unfolds) {
    FacePoint point{corners, NONE, unfolds, {}, edge_length, {}, {}};
    for (size_t k = 0; k < 3; ++k) {
        const size_t first = (k + 1) % 3, second = (k + 2) % 3;
        const double length = edge_length[k], to_apex = edge_length[second], other = edge_length[first];
        const double apex_foot =
            length > 0 ? (to_apex - other) * (to_apex + other) / (2 * length) + length / 2 : 0;
        const double apex_height = std::sqrt(std::max(0.0, (to_apex - apex_foot) * (to_apex + apex_foot)));
        point.foot[k] = weights[second] * length + weights[k] * apex_foot;
        point.height[k] = weights[k] * apex_height;
        point.to_corner[first] = std::hypot(point.foot[k], point.height[k]);
        if (weights[k] == 1) point.vertex = corners[k];
    }
    return point;
}

double distance_over(const FacePoint& point, const std::array<double, 3>& from_corners) {
    double least = std::numeric_limits<double>::infinity();
    for (size_t k = 0; k < 3; ++k) {
        least = std::min(least, point.to_corner[k] + from_corners[k]);
        if (point.unfolds)
            least = std::min(least,
                             straight_over(point, k, from_corners[(k + 1) % 3], from_corners[(k + 2) % 3]));
    }
    return least;
}

}
