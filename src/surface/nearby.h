#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "src/surface/surface.h"

namespace geodesic {

// How far along a line a point is, and how far off it.
struct Place {
    double foot, height;
};

// Of a line that begins there, with a direction of length 1.
inline Place place_beside(const Eigen::Vector3d& begin, const Eigen::Vector3d& direction,
                          const Eigen::Vector3d& point) {
    const Eigen::Vector3d to = point - begin;
    const double foot = to.dot(direction);
    return {foot, (to - foot * direction).norm()};
}

// Whether any face has both points. A point on an edge or at a vertex is a point of all faces there.
bool share_a_face(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b);

// The length of the straight line between two points as points of those faces only that they are given on: in
// one face, or over an edge that both faces share; infinite if there is none.
double straight_between(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b);

// The least of these over all faces that the points lie in; infinite if there is none.
double straight_nearby(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b);

// The length of the shorter way, in the faces that two points are given on, over a corner that both have;
// infinite if there is none.
double over_corner(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b);

// The same in any faces that the points lie in.
double over_any_corner(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b);

// The length of the straight line between two points of different faces that share a corner, around that
// corner (see corner_fan.h); infinite if there is none.
double straight_around_any_corner(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b);

// The length of the straight line between two points if it runs over faces of one plane in which edges were
// flipped; infinite otherwise.
double straight_in_plane(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b);

// Calls use(point) for the point as one of each face that it lies in.
template <class Use>
void for_each_alias(const Surface& surface, const SurfacePoint& point, const Use& use) {
    use(point);
    for (size_t k = 0; k < 3; ++k) {
        const auto& corners = surface.faces[point.face];
        if (point.weights[k] == 1) {
            for (const uint32_t face : surface.vertex_faces[corners[k]])
                if (face != point.face) use(corner_point(surface, face, corners[k]));
            return;
        }
    }
    for (uint32_t k = 0; k < 3; ++k) {
        if (point.weights[k] != 0) continue;
        const uint32_t i = (k + 1) % 3, j = (k + 2) % 3;
        const uint32_t a = surface.faces[point.face][i], b = surface.faces[point.face][j];
        for_each_face_beyond(surface, point.face, a, b, [&](uint32_t face) {
            SurfacePoint alias{face, {}};
            alias.weights[corner_of(surface, face, a)] = point.weights[i];
            alias.weights[corner_of(surface, face, b)] = point.weights[j];
            use(alias);
        });
        return;
    }
}

// The same points, ascending by face.
std::vector<SurfacePoint> aliases_of(const Surface& surface, const SurfacePoint& point);

// The alias in a face, or NULL.
inline const SurfacePoint* alias_in(std::span<const SurfacePoint> aliases, uint32_t face) {
    const auto found = std::ranges::lower_bound(aliases, face, {}, &SurfacePoint::face);
    return found != aliases.end() && found->face == face ? &*found : nullptr;
}

// The point with the weights of a face, if it lies in that face.
std::optional<SurfacePoint> point_in_face(const Surface& surface, const SurfacePoint& point, uint32_t face);

// Whether two points are one, be it of different faces.
bool is_same_point(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b);

}
