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
// mend_square in src/overlay/kernels/unfolding.h).
bool place(double length, double from_first, double from_second, Placed& placed) {
    if (!(length > 0)) return false;
    placed.foot = foot_of(length, from_first, from_second);
    const double square = (from_first - placed.foot) * (from_first + placed.foot);
    if (!(square >= length * length / -32)) return false;
    placed.height = std::sqrt(std::max(square, 0.0));
    return true;
}

// The straight way over an edge, or infinity where it does not cross the part that is seen. Where both the
// point and the vertex lie in line with the edge, as a point of the edge and a vertex that cuts it do, it
// runs along the edge from the point.
double way_over(const FacePoint::Edge& edge, double from_first, double from_second) {
    Placed placed;
    if (!place(edge.length, from_first, from_second, placed)) return NO_WAY;
    const double off = edge.height + placed.height;
    const double crossing = off > 0 ? edge.foot * placed.height + placed.foot * edge.height : edge.foot,
                 weight = off > 0 ? off : 1;
    if (!(crossing >= edge.seen_from * weight && crossing <= edge.seen_to * weight)) return NO_WAY;
    return hypotenuse(edge.foot - placed.foot, off);
}

}

// The position follows from the weights alone: the origin is the first end of the edge.
FacePoint face_point(const std::array<uint32_t, 3>& corners, const std::array<double, 3>& edge_length,
                     const std::array<double, 3>& weights, const std::array<bool, 3>& crosses) {
    FacePoint point;
    point.vertex_count = 3;
    for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t first = (k + 1) % 3, second = (k + 2) % 3;
        Placed apex{0, 0};
        place(edge_length[k], edge_length[second], edge_length[first], apex);
        const double foot = weights[second] * edge_length[k] + weights[k] * apex.foot,
                     height = weights[k] * apex.height;
        point.numbers[k] = corners[k];
        point.straight[first] = hypotenuse(foot, height);
        if (crosses[k]) {
            point.edges[point.edge_count++] = {first,  second, edge_length[k], foot,
                                               height, 0,      edge_length[k]};
            point.longest_edge = std::max(point.longest_edge, edge_length[k]);
        }
        if (weights[k] == 1) point.vertex = corners[k];
    }
    return point;
}

// Distances from the vertices may be those of ways that come from different sides. Then no unfolding is
// right, and the straight way may be far too short; but two sides of a triangle are never shorter than the
// third.
double distance_over(const FacePoint& point, std::span<const double> from_vertices) {
    double least = NO_WAY, certain = 0;
    for (size_t k = 0; k < point.vertex_count; ++k) {
        least = std::min(least, point.straight[k] + from_vertices[k]);
        certain = std::max(certain, from_vertices[k] - point.straight[k]);
    }
    for (const FacePoint::Edge& edge : std::span(point.edges).first(point.edge_count))
        least = std::min(least, way_over(edge, from_vertices[edge.first], from_vertices[edge.second]));
    return std::max(least, certain);
}

}
