#include "src/path/nearby.h"

#include <algorithm>
#include <cmath>

#include "src/base/plane.h"

namespace geodesic {

namespace {

using Eigen::Vector3d;

double straight_across(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b, uint32_t edge) {
    const Vector3d first = surface.positions[surface.faces[a.face][(edge + 1) % 3]],
                   along = surface.positions[surface.faces[a.face][(edge + 2) % 3]] - first;
    const double length = along.norm();
    const Place from = place_beside(first, along / length, position_of(surface, a)),
                to = place_beside(first, along / length, position_of(surface, b));
    const double off = from.height + to.height;
    if (!(off > 0)) return std::abs(from.foot - to.foot);
    const double crossing = (from.foot * to.height + to.foot * from.height) / off;
    return crossing >= 0 && crossing <= length ? hypotenuse(from.foot - to.foot, off) : UNREACHABLE;
}

double straight_between(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b) {
    if (a.face == b.face) return (position_of(surface, a) - position_of(surface, b)).norm();
    for (uint32_t k = 0; k < 3; ++k)
        if (corner_of(surface, b.face, surface.faces[a.face][(k + 1) % 3]) != NONE &&
            corner_of(surface, b.face, surface.faces[a.face][(k + 2) % 3]) != NONE)
            return straight_across(surface, a, b, k);
    return UNREACHABLE;
}

template <class Length>
double least_of_aliases(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b,
                        const Length& length) {
    double least = UNREACHABLE;
    for_each_alias(surface, a, [&](const SurfacePoint& from) {
        for_each_alias(surface, b,
                       [&](const SurfacePoint& to) { least = std::min(least, length(from, to)); });
    });
    return least;
}

}

double straight_nearby(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b) {
    return least_of_aliases(surface, a, b, [&](const SurfacePoint& from, const SurfacePoint& to) {
        return straight_between(surface, from, to);
    });
}

double straight_in_plane(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b) {
    return least_of_aliases(surface, a, b, [&](const SurfacePoint& from, const SurfacePoint& to) {
        return surface.flat_faces.straight(surface, from, to);
    });
}

std::optional<SurfacePoint> point_in_face(const Surface& surface, const SurfacePoint& point, uint32_t face) {
    std::optional<SurfacePoint> found;
    for_each_alias(surface, point, [&](const SurfacePoint& alias) {
        if (alias.face == face) found = alias;
    });
    return found;
}

bool is_same_point(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b) {
    const auto found = point_in_face(surface, a, b.face);
    return found && found->weights == b.weights;
}

}
