#include "src/path/edge_crossing.h"

#include <algorithm>
#include <cmath>

#include "src/base/plane.h"
#include "src/surface/nearby.h"

namespace geodesic {

namespace {

// Over a piece of a line, from `begin` to `end`, whose ends have these distances from the target. They are
// rounded: a target whose square is not below LEAST_SQUARE is on the line or beside it. The way comes from a
// point at `foot` along the line and `height` off it. To a target that is placed at both distances the way is
// the longer the farther it crosses the line from where the straight way does.
void cross_piece(double begin, double end, double from_begin, double from_end, double foot, double height,
                 double& least, double& at, double& rest) {
    const auto offer = [&](double x, double way_on) {
        const double length = hypotenuse(x - foot, height) + way_on;
        if (!(length < least)) return;
        least = length;
        at = x;
        rest = way_on;
    };
    const double length = end - begin;
    const double target = foot_of(length, from_begin, from_end);
    const double square = (from_begin - target) * (from_begin + target);
    const double off = std::sqrt(std::max(square, 0.0)), both = off + height;
    const double x = foot - begin + (target - foot + begin) * (height / both);
    const bool is_placed =
        length > 0 && square >= length * length * double{LEAST_SQUARE} && square < UNREACHABLE && both > 0;
    const bool is_at_both_distances = is_placed && square >= 0;
    if (!is_at_both_distances || !(x > 0)) offer(begin, from_begin);
    if (!is_at_both_distances || !(x < length)) offer(end, from_end);
    if (is_placed && x > 0 && x < length) offer(begin + x, hypotenuse(x - target, off));
}

}

EdgeCrossing cross_edge(const Surface& surface, uint32_t a, uint32_t b, const Eigen::Vector3d& from,
                        double from_a, std::span<const double> inside, double from_b) {
    const Eigen::Vector3d along = surface.positions[b] - surface.positions[a];
    const double length = along.norm();
    const auto [foot, height] = place_beside(surface.positions[a], along / length, from);
    double least = UNREACHABLE, at = 0, last = from_a, rest = UNREACHABLE;
    const double piece = length / static_cast<double>(inside.size() + 1);
    for (size_t i = 0; i <= inside.size(); ++i) {
        const double next = i < inside.size() ? inside[i] : from_b;
        const double begin = static_cast<double>(i) * piece;
        cross_piece(begin, begin + piece, last, next, foot, height, least, at, rest);
        last = next;
    }
    return {std::clamp(at / length, 0.0, 1.0), rest};
}

}
