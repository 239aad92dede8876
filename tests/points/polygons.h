#pragma once

#include <cmath>
#include <random>
#include <span>

#include "src/points/seen_faces.h"
#include "src/surface/indexed_faces.h"
#include "tests/support/meshes.h"

// Polygons of points by what is known of the faces around them.
namespace geodesic::test {

// Knows all faces; the number of a vertex is the vertex itself.
struct AllKnown : KnownFaces {
    uint32_t number_of(uint32_t vertex) const override { return vertex; }
    bool go_on(uint32_t, uint32_t, double) const override { return true; }
    size_t find_between(uint32_t, uint32_t, double, std::span<VertexBetween>) const override { return 0; }
};

// Within a face, or on an edge.
inline SurfacePoint random_point(const Surface& surface, std::mt19937_64& random, size_t turn) {
    SurfacePoint point{static_cast<uint32_t>(random() % surface.face_count()), {}};
    for (double& weight : point.weights) weight = uniform(random, 0.05, 1);
    if (turn % 3 == 2) point.weights[random() % 3] = 0;
    const double sum = point.weights[0] + point.weights[1] + point.weights[2];
    for (double& weight : point.weights) weight /= sum;
    return point;
}

struct Polygon {
    FacePoint alone, point;
    SeenFaces faces;
};

// `at` is a point of the faces that an index has.
inline Polygon look(const Surface& surface, const SurfacePoint& at, const KnownFaces& known = AllKnown(),
                    size_t most = FacePoint::MOST_VERTICES) {
    const auto& corners = indexed_corners(surface, at.face);
    std::array<bool, 3> crosses{};
    for (size_t k = 0; k < 3; ++k) {
        const uint32_t a = corners[(k + 1) % 3], b = corners[(k + 2) % 3];
        for_each_indexed_face_beyond(surface, at.face, a, b, [&](uint32_t) { crosses[k] = true; });
    }
    Polygon seen{face_point(corners, edge_lengths(surface, corners), at.weights, crosses), {}, {}};
    seen.point = seen.alone;
    see_farther(surface, at, known, most, seen.point, seen.faces);
    return seen;
}

inline double angle_seen(const FacePoint& point) {
    double sum = 0;
    for (const FacePoint::Edge& edge : std::span(point.edges).first(point.edge_count))
        sum += std::atan2(edge.seen_to - edge.foot, edge.height) -
               std::atan2(edge.seen_from - edge.foot, edge.height);
    return sum;
}

}
