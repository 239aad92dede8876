#pragma once

#include <functional>
#include <vector>

#include "src/path/strip.h"
#include "src/surface/surface.h"

namespace geodesic {

// A path over a surface: the piece from each point to the next lies in the face of the first of them.
struct SurfacePath {
    std::vector<SurfacePoint> points;
    std::vector<double> pieces; // how long each is, as the metric has it
    double length = 0;          // their sum
};

enum class PathQuality { STRAIGHT, EXACT };

// Throws Error NO_PATH.
[[noreturn]] void no_path();

// As point_at(), but a share within NEGLIGIBLE_WEIGHT of 0 or 1 is that, so that callers get a point at the
// vertex.
SurfacePoint passed_point(const Surface& surface, uint32_t face, const Portal& portal, double share);

// Adds a point, but replaces the last one if it is the same point: the next piece lies in the face of the
// later one. Different points at one place, as on two sides of a face without area, both stay, since pieces
// to them lie in different faces.
void add_point(const Surface& surface, const SurfacePoint& point, std::vector<SurfacePoint>& points);

// The path over these points. If there is only one, the target is added, so that there are at least two.
// length_of_piece(points, i) is that from point i to the next one.
SurfacePath
path_of_points(std::vector<SurfacePoint>&& points, const SurfacePoint& target,
               const std::function<double(const std::vector<SurfacePoint>&, size_t)>& length_of_piece);

// The path of length 0 between two points that are one, be it of different faces (see is_same_point).
SurfacePath path_within_point(const SurfacePoint& source, const SurfacePoint& target);

// How far two consecutive points are apart in space.
double distance_to_next(const Surface& surface, const std::vector<SurfacePoint>& points, size_t i);

}
