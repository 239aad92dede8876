#include "src/surface/nearby.h"

#include <algorithm>
#include <cmath>

#include "src/base/plane.h"
#include "src/surface/corner_fan.h"

namespace geodesic {

namespace {

using Eigen::Vector3d;

// Over the edge between two vertices. Where the line leads through an end of it, rounding tells whether it
// crosses the edge, and so the direction of the edge must not depend on which point comes first.
double straight_across(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b, uint32_t v,
                       uint32_t w) {
    const Vector3d first = surface.positions[std::min(v, w)],
                   along = surface.positions[std::max(v, w)] - first;
    const double length = along.norm();
    const Place from = place_beside(first, along / length, position_of(surface, a)),
                to = place_beside(first, along / length, position_of(surface, b));
    const double off = from.height + to.height;
    if (!(off > 0)) {
        // Both on the line of the edge, in faces without area if beyond its ends.
        const double at = std::clamp(from.foot, 0.0, length);
        return std::abs(from.foot - at) + std::abs(at - to.foot);
    }
    const double crossing = (from.foot * to.height + to.foot * from.height) / off;
    return crossing >= 0 && crossing <= length ? hypotenuse(from.foot - to.foot, off) : UNREACHABLE;
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

// Of the corners that their faces share.
template <class Length>
double least_of_corners(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b,
                        const Length& length) {
    double least = UNREACHABLE;
    for (const uint32_t corner : surface.faces[a.face])
        if (has_corner(surface, b.face, corner)) least = std::min(least, length(corner));
    return least;
}

}

bool share_a_face(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b) {
    if (a.face == b.face) return true;
    const auto has_point = [&](uint32_t face, const SurfacePoint& point) {
        for (size_t k = 0; k < 3; ++k)
            if (point.weights[k] != 0 && !has_corner(surface, face, surface.faces[point.face][k]))
                return false;
        return true;
    };
    const auto k = static_cast<size_t>(std::ranges::max_element(a.weights) - a.weights.begin());
    return std::ranges::any_of(surface.vertex_faces[surface.faces[a.face][k]],
                               [&](uint32_t face) { return has_point(face, a) && has_point(face, b); });
}

double straight_between(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b) {
    if (a.face == b.face) return (position_of(surface, a) - position_of(surface, b)).norm();
    const auto& corners = surface.faces[a.face];
    for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t v = corners[(k + 1) % 3], w = corners[(k + 2) % 3];
        if (has_corner(surface, b.face, v) && has_corner(surface, b.face, w))
            return straight_across(surface, a, b, v, w);
    }
    return UNREACHABLE;
}

double straight_nearby(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b) {
    return least_of_aliases(surface, a, b, [&](const SurfacePoint& from, const SurfacePoint& to) {
        return straight_between(surface, from, to);
    });
}

double over_corner(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b) {
    return least_of_corners(surface, a, b, [&](uint32_t corner) {
        const Vector3d& at = surface.positions[corner];
        const double from_a = (position_of(surface, a) - at).norm(),
                     from_b = (position_of(surface, b) - at).norm();
        return from_a + from_b;
    });
}

double over_any_corner(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b) {
    return least_of_aliases(surface, a, b, [&](const SurfacePoint& from, const SurfacePoint& to) {
        return over_corner(surface, from, to);
    });
}

double straight_around_any_corner(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b) {
    return least_of_aliases(surface, a, b, [&](const SurfacePoint& from, const SurfacePoint& to) {
        if (from.face == to.face) return UNREACHABLE;
        const uint32_t here = vertex_at(surface, from), there = vertex_at(surface, to);
        return least_of_corners(surface, from, to, [&](uint32_t corner) {
            const bool is_end = corner == here || corner == there;
            return is_end ? UNREACHABLE : straight_around(surface, from, to, corner);
        });
    });
}

double straight_in_plane(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b) {
    return least_of_aliases(surface, a, b, [&](const SurfacePoint& from, const SurfacePoint& to) {
        return surface.flat_faces.straight(surface, from, to);
    });
}

std::vector<SurfacePoint> aliases_of(const Surface& surface, const SurfacePoint& point) {
    std::vector<SurfacePoint> aliases;
    for_each_alias(surface, point, [&](const SurfacePoint& alias) { aliases.push_back(alias); });
    std::ranges::sort(aliases, {}, &SurfacePoint::face);
    return aliases;
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
