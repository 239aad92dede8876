#include "src/index/face_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/base/plane.h"

namespace geodesic {

namespace {

constexpr double NO_WAY = std::numeric_limits<double>::infinity();

// A vertex in the plane of an edge, on the far side of it.
struct Placed {
    double foot, height;
};

// Places a vertex by its distances from the ends of an edge. Returns whether there is such a place (see
// mend_square in src/overlay/unfolding.h).
bool place(double length, double from_first, double from_second, Placed& placed) {
    if (!(length > 0)) return false;
    placed.foot = foot_of(length, from_first, from_second);
    const double square = (from_first - placed.foot) * (from_first + placed.foot);
    if (!(square >= length * length / -32)) return false;
    placed.height = std::sqrt(std::max(square, 0.0));
    return true;
}

// The straight way from a point on the near side, or infinity where it does not cross the edge.
double straight_to(const Placed& placed, double length, double foot, double height) {
    const double off = height + placed.height;
    const double crossing = foot * placed.height + placed.foot * height;
    if (!(crossing > 0 && crossing < length * off)) return NO_WAY;
    return hypotenuse(foot - placed.foot, off);
}

// The way over edge k. Where the straight way to the third corner is shorter than that corner is far, no
// vertex is at that place: the distances come from different sides, or are rounded. Then the way is longer by
// as much as the point is near to that corner, so that it is right at all three.
double way_over(const FacePoint& point, size_t k, const std::array<double, 3>& from_corners) {
    const double length = point.edge_length[k];
    Placed placed;
    if (!place(length, from_corners[(k + 1) % 3], from_corners[(k + 2) % 3], placed)) return NO_WAY;
    const double straight = straight_to(placed, length, point.foot[k], point.height[k]);
    if (!(straight < NO_WAY)) return NO_WAY;
    const double to_apex = straight_to(placed, length, point.apex_foot[k], point.apex_height[k]);
    const double missing = from_corners[k] - to_apex;
    return missing > 0 && missing < NO_WAY ? straight + point.weights[k] * missing : straight;
}

}

// The position follows from the weights alone: the origin is the first end of the edge.
FacePoint face_point(const std::array<uint32_t, 3>& corners, const std::array<double, 3>& edge_length,
                     const std::array<double, 3>& weights, const std::array<bool, 3>& crosses) {
    FacePoint point{corners, NONE, crosses, {}, edge_length, weights, {}, {}, {}, {}};
    for (size_t k = 0; k < 3; ++k) {
        const size_t first = (k + 1) % 3, second = (k + 2) % 3;
        Placed apex{0, 0};
        place(edge_length[k], edge_length[second], edge_length[first], apex);
        point.apex_foot[k] = apex.foot;
        point.apex_height[k] = apex.height;
        point.foot[k] = weights[second] * edge_length[k] + weights[k] * apex.foot;
        point.height[k] = weights[k] * apex.height;
        point.to_corner[first] = hypotenuse(point.foot[k], point.height[k]);
        if (weights[k] == 1) point.vertex = corners[k];
    }
    return point;
}

// Distances from the corners may be those of ways that come from different sides. Then no unfolding is right,
// and the straight way may be far too short; but two sides of a triangle are never shorter than the third.
double distance_over(const FacePoint& point, const std::array<double, 3>& from_corners) {
    double least = NO_WAY, certain = 0;
    for (size_t k = 0; k < 3; ++k) {
        least = std::min(least, point.to_corner[k] + from_corners[k]);
        certain = std::max(certain, from_corners[k] - point.to_corner[k]);
        if (point.crosses[k]) least = std::min(least, way_over(point, k, from_corners));
    }
    return std::max(least, certain);
}

}
