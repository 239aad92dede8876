#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "src/path/strip.h"

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

// The face of a strip that was unfolded last, as whoever came into it sees its vertices: two at the edge that
// it was entered by, and the third one ahead.
class UnfoldedFace {
public:
    // Which ends of a portal are not those of the portal before.
    enum class NewEnds { LEFT, RIGHT, BOTH };

    UnfoldedFace(const Surface& surface, uint32_t face);

    // Goes on into the next face, whose third vertex is placed ahead. The ends of the portal are then left()
    // and right().
    NewEnds go_through(const Portal& portal, uint32_t next_face) {
        const bool goes_on = portal.contains(ahead_.vertex), keeps_left = portal.contains(left_.vertex);
        if (!goes_on)
            std::swap(left_, right_);
        else
            (keeps_left ? right_ : left_) = ahead_;
        const auto& next = surface_.faces[next_face];
        ahead_.vertex = next[0] + next[1] + next[2] - portal.a - portal.b; // the one that is no end
        ahead_.at = place_ahead(surface_, left_, right_, ahead_.vertex);
        face_ = next_face;
        return !goes_on ? NewEnds::BOTH : keeps_left ? NewEnds::RIGHT : NewEnds::LEFT;
    }

    const PlacedVertex& left() const { return left_; }
    const PlacedVertex& right() const { return right_; }

    // A point of the face, by its weights.
    Eigen::Vector2d place(const std::array<double, 3>& weights) const;

private:
    const Surface& surface_;
    uint32_t face_;
    PlacedVertex left_, right_, ahead_;
};

}
