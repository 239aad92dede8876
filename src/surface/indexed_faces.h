#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "src/surface/surface.h"

namespace geodesic {

// The faces that an index by positions was made on: those of the surface but, in planes where
// flip_flat_edges() flips edges, the flipped ones. Both have the same numbers.
inline const std::array<uint32_t, 3>& indexed_corners(const Surface& surface, uint32_t face) {
    return surface.flat_faces.has(face) ? surface.flat_faces.corners(face) : surface.faces[face];
}

// The lengths of the edges between three corners. Edge k is opposite to corner k.
inline std::array<double, 3> edge_lengths(const Surface& surface, const std::array<uint32_t, 3>& corners) {
    const auto length = [&](size_t a, size_t b) {
        return (surface.positions[corners[a]] - surface.positions[corners[b]]).norm();
    };
    return {length(1, 2), length(2, 0), length(0, 1)};
}

// How many edges the component is across that a face with these corners lies in.
inline double edges_across(const Surface& surface, const std::array<uint32_t, 3>& corners) {
    return surface.components.of(corners[0]).edges_across(std::ranges::max(edge_lengths(surface, corners)));
}

// Whether the edges around such a face are long for what the surface does.
inline bool has_long_edges(const Surface& surface, const std::array<uint32_t, 3>& corners) {
    return are_long_edges(edges_across(surface, corners));
}

// Calls use(face) for every other one of these faces at the edge between two vertices of a face.
template <class Use>
void for_each_indexed_face_beyond(const Surface& surface, uint32_t face, uint32_t a, uint32_t b,
                                  const Use& use) {
    const FlatFaces& flat = surface.flat_faces;
    for_each_face_beyond(surface, face, a, b, [&](uint32_t other) {
        if (!flat.has(other)) use(other);
    });
    flat.for_each_around(a, [&](uint32_t other) {
        const auto& [i, j, k] = flat.corners(other);
        if (other != face && (i == b || j == b || k == b)) use(other);
    });
}

// A face that an index was made on, or one of the surface itself.
struct AnyFace {
    bool is_of_index;
    uint32_t face;
};

inline std::array<uint32_t, 3> corners_of(const Surface& surface, const AnyFace& face) {
    return face.is_of_index ? indexed_corners(surface, face.face) : surface.faces[face.face];
}

// Calls use(face) for every other face of the same kind at the edge between two corners of a face.
template <class Use>
void for_each_beyond(const Surface& surface, const AnyFace& face, uint32_t a, uint32_t b, const Use& use) {
    const auto use_face = [&](uint32_t other) { use(AnyFace{face.is_of_index, other}); };
    if (face.is_of_index)
        for_each_indexed_face_beyond(surface, face.face, a, b, use_face);
    else
        for_each_face_beyond(surface, face.face, a, b, use_face);
}

inline bool has_face_beyond(const Surface& surface, const AnyFace& face, uint32_t a, uint32_t b) {
    bool is_there = false;
    for_each_beyond(surface, face, a, b, [&](const AnyFace&) { is_there = true; });
    return is_there;
}

// A point of the surface as one of these faces. Nothing where rounding hides which of several flipped faces
// it lies in.
inline std::optional<SurfacePoint> indexed_point(const Surface& surface, const SurfacePoint& point) {
    if (!surface.flat_faces.has(point.face)) return point;
    return surface.flat_faces.find(surface, point);
}

}
