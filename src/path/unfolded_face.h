#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "src/path/strip.h"
#include "src/surface/unfolded_vertex.h"

namespace geodesic {

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
