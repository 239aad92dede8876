#pragma once

#include <cmath>
#include <cstdint>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "src/surface/surface.h"

namespace geodesic {

// Twice the area of the triangle that two vectors of the plane span, positive where b is to the left of a.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
}

// A vertex, and where it is in the plane.
struct PlacedVertex {
    uint32_t vertex;
    Eigen::Vector2d at;
};

// The third vertex of a triangle with an edge that is placed. Vertices that are one but for rounding are
// placed at one point, since no direction from one to the other is left there. What is measured in space does
// not depend on where the edge is placed, so that processors measure several faces at once.
inline Eigen::Vector2d place_ahead(const Surface& surface, const PlacedVertex& left,
                                   const PlacedVertex& right, uint32_t ahead) {
    constexpr double SAME = 1e-12; // of the edge's length
    const Eigen::Vector3d& begin = surface.positions[right.vertex];
    const Eigen::Vector3d along = surface.positions[left.vertex] - begin,
                          to = surface.positions[ahead] - begin;
    const double square = along.squaredNorm(), length = std::sqrt(square);
    const double foot = to.dot(along) / length, height = along.cross(to).norm() / length;
    const Eigen::Vector2d across = left.at - right.at;
    const double placed_length = across.norm();
    if (!(placed_length > 0)) return right.at + Eigen::Vector2d(to.norm(), 0);
    if (to.squaredNorm() < square * (SAME * SAME)) return right.at;
    if ((to - along).squaredNorm() < square * (SAME * SAME)) return left.at;
    const Eigen::Vector2d direction = across / placed_length;
    return right.at + foot * direction + height * Eigen::Vector2d(direction.y(), -direction.x());
}

}
