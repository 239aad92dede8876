#pragma once

#include <array>
#include <cstdint>

#include "src/base/numbers.h"

namespace geodesic {

// A point of a face as queries take it: where it lies in the plane of the face, and the numbers of the
// corners. Edge k is opposite to corner k, and leads from corner k + 1 to corner k + 2.
struct FacePoint {
    std::array<uint32_t, 3> corners;
    uint32_t vertex;             // the corner that the point is at, or NONE
    std::array<bool, 3> crosses; // whether a way may cross the edge anywhere; over others none leads
    std::array<double, 3> to_corner;
    std::array<double, 3> edge_length;
    std::array<double, 3> weights;
    std::array<double, 3> foot, height;           // in the plane of edge k: how far along it, and how far off
    std::array<double, 3> apex_foot, apex_height; // the same of corner k
};

// A point with these weights on a face with these lengths of edges.
FacePoint face_point(const std::array<uint32_t, 3>& corners, const std::array<double, 3>& edge_length,
                     const std::array<double, 3>& weights, const std::array<bool, 3>& crosses);

// The distance of a vertex from the point, by the distances of the vertex from the three corners: straight
// over one of the edges, where the vertex is placed on the far side of it, or over a corner.
double distance_over(const FacePoint& point, const std::array<double, 3>& from_corners);

}
