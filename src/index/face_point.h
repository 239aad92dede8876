#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "src/base/numbers.h"

namespace geodesic {

// A point of a face as queries take it: a polygon of faces around the point, unfolded into the plane of its
// own face. The point sees all of the polygon's edges, or the parts of them that are given, from inside. In
// the least case the polygon is the face itself.
struct FacePoint {
    // Where edges have several faces behind them, there is an edge for each of these, up to MOST_BEHIND.
    static constexpr size_t MOST_VERTICES = 128, MOST_BEHIND = 4,
                            MOST_EDGES = MOST_VERTICES + 2 * MOST_BEHIND;

    // An edge that ways may cross, in a plane of its own: the first end is at 0, the second one at (length,
    // 0), and the point at (foot, height). Ways may cross it from `seen_from` to `seen_to`.
    struct Edge {
        uint32_t first, second; // of the vertices below
        double length, foot, height, seen_from, seen_to;
    };

    // A vertex that the point sees and that is not of the polygon.
    struct Beyond {
        uint32_t number;
        double straight; // from the point
    };

    uint32_t vertex = NONE; // the number of the corner that the point is at, or NONE
    uint32_t leaf = NONE;   // a leaf whose tables have all vertices of the polygon, or NONE
    uint32_t vertex_count = 0, edge_count = 0;
    double longest_edge = 0;                     // of the polygon; those below may be parts of its edges
    std::array<uint32_t, MOST_VERTICES> numbers; // of the vertices; the corners of the face come first
    std::array<double, MOST_VERTICES> straight;  // from each vertex to the point; infinite if it is not seen
    std::array<Edge, MOST_EDGES> edges;
    uint32_t beyond_count = 0; // filled for fields only
    std::array<Beyond, MOST_VERTICES> beyond;

    // Whether tables tell of it by one vertex, or by all of one leaf. If not, the corners of its face do.
    bool has_tables() const { return vertex != NONE || leaf != NONE; }
    std::array<uint32_t, 3> corners() const { return {numbers[0], numbers[1], numbers[2]}; }
};

// A vertex between the ends of an edge, and how far it is from the first end.
struct VertexBetween {
    uint32_t number;
    double along;
};

// A point with these weights on a face with these lengths of edges. Edge k is opposite to corner k, and leads
// from corner k + 1 to corner k + 2. Ways may cross the edges of which `crosses` says so.
FacePoint face_point(const std::array<uint32_t, 3>& corners, const std::array<double, 3>& edge_length,
                     const std::array<double, 3>& weights, const std::array<bool, 3>& crosses);

// The distance of a vertex from the point, by the distances of that vertex from the vertices of the polygon:
// straight over one of the edges, where the vertex is placed on the far side of it, or over a vertex that is
// seen.
double distance_over(const FacePoint& point, std::span<const double> from_vertices);

}
