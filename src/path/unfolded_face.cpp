#include "src/path/unfolded_face.h"

namespace geodesic {

using Eigen::Vector2d;

// The vertices of the first face lie counterclockwise.
UnfoldedFace::UnfoldedFace(const Surface& surface, uint32_t face) : surface_(surface), face_(face) {
    const auto [left, right, ahead] = surface.faces[face];
    const double length = (surface.positions[left] - surface.positions[right]).norm();
    left_ = {left, Vector2d(0, 0)};
    right_ = {right, Vector2d(length, 0)};
    ahead_ = {ahead, place_ahead(surface, left_, right_, ahead)};
}

Vector2d UnfoldedFace::place(const std::array<double, 3>& weights) const {
    Vector2d at(0, 0);
    for (const PlacedVertex* corner : {&left_, &right_, &ahead_})
        at += weights[corner_of(surface_, face_, corner->vertex)] * corner->at;
    return at;
}

}
