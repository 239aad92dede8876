#include "src/path/edge_crossing.h"

#include <algorithm>
#include <cmath>

#include "src/base/plane.h"
#include "src/surface/nearby.h"

namespace geodesic {

// The distances of a and b from the target place it in the plane of the edge, on its far side; `square` is
// that of its height off the edge's line. Distances are rounded: a little less than 0, down to LEAST_SQUARE
// of the squared length, counts as 0. Below that they contradict each other, and only the ends of the edge
// are offered. The way comes from a point at `foot` along that line and `height` off it. To a target that is
// placed at both distances the way is the longer the farther it crosses the edge from where the straight way
// does.
EdgeCrossing cross_edge(const Surface& surface, uint32_t a, uint32_t b, const Eigen::Vector3d& from,
                        double rest_a, double rest_b) {
    const Eigen::Vector3d along = surface.positions[b] - surface.positions[a];
    const double length = along.norm();
    if (!(length > 0)) return {0, std::min(rest_a, rest_b)};
    const auto [foot, height] = place_beside(surface.positions[a], along / length, from);
    EdgeCrossing best;
    double least = UNREACHABLE;
    const auto offer = [&best, &least, foot = foot, height = height, length](double x, double rest) {
        const double way = hypotenuse(x - foot, height) + rest;
        if (!(way < least)) return;
        least = way;
        best = {std::clamp(x / length, 0.0, 1.0), rest};
    };
    const double target = foot_of(length, rest_a, rest_b);
    const double square = (rest_a - target) * (rest_a + target);
    const double off = std::sqrt(std::max(square, 0.0)), both = off + height;
    const double x = foot + (target - foot) * (height / both);
    const bool is_placed =
        square >= length * length * double{LEAST_SQUARE} && square < UNREACHABLE && both > 0;
    const bool is_at_both_distances = is_placed && square >= 0;
    if (!is_at_both_distances || !(x > 0)) offer(0, rest_a);
    if (!is_at_both_distances || !(x < length)) offer(length, rest_b);
    if (is_placed && x > 0 && x < length) offer(x, hypotenuse(x - target, off));
    return best;
}

}
