#pragma once

#include "src/points/point_queries.h"

namespace geodesic {

// The distance of two points of a surface, the same in both directions: by the tables of the index or, where
// these may say little (see PointQueries::Pair), the length of a path between them (see length_of_near_path).
// Throws Error as PointQueries does.
float distance_of_points(const Index& index, Query& query, const Surface& surface, const SurfacePoint& source,
                         const SurfacePoint& target);

}
