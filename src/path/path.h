#pragma once

#include <cstdint>
#include <vector>

#include "src/path/point_queries.h"
#include "src/path/strip.h"

namespace geodesic {

// A path over a surface: the piece from each point to the next lies in the face of the first of them.
struct SurfacePath {
    std::vector<SurfacePoint> points;
    double length = 0;
};

enum class PathQuality { STRAIGHT, EXACT };

// Finds a path between two points of a surface, led by the distances of an index. Throws Error NO_PATH where
// there is none.
SurfacePath find_path(const Index& index, Query& query, const Surface& surface, const SurfacePoint& source,
                      const SurfacePoint& target, PathQuality quality);

// A path of STRAIGHT quality as its strip, for metrics that unfold.
struct StraightPath {
    Strip strip;
    StripPath path;
};
StraightPath find_straight_path(const Index& index, Query& query, const Surface& surface,
                                const SurfacePoint& source, const SurfacePoint& target);

}
