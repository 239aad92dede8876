#pragma once

#include <optional>

#include "src/path/strip.h"
#include "src/path/surface_path.h"
#include "src/points/point_queries.h"

namespace geodesic {

// Throws an Error where no path by the metric of the index can end at a point of the surface: MESH_MISMATCH
// where it is of another mesh, INVALID_ARGUMENT, with the point's name, where the surface lacks costs that
// the metric needs, where that has lengths of edges, which do not say how triangles lie, or where paths end
// at vertices only and the point is none.
void require_path_end(const Index& index, const Surface& surface, const SurfacePoint& point,
                      const char* name);

// Finds a path between two points of a surface, led by the distances of an index. Throws Error as
// require_path_end does for each of them, and NO_PATH where there is none.
SurfacePath find_path(const Index& index, Query& query, const Surface& surface, const SurfacePoint& source,
                      const SurfacePoint& target, PathQuality quality);

// A path of STRAIGHT quality, with its strip, by the exact metric only: require_path_end has been asked about
// both ends. Throws Error NO_PATH where there is none.
StripWay find_straight_path(const Index& index, Query& query, const Surface& surface,
                            const SurfacePoint& source, const SurfacePoint& target);

// The length of a shortest path between near points, by the exact metric only, of which tables say that it is
// so long: of one of STRAIGHT quality or, if that is longer, of a shortest one in the corridor. Nothing where
// no strip is found in so many steps, or where the corridor is too large. Throws Error as PointQueries does,
// and INVALID_ARGUMENT where the index does not have all corners of a face.
std::optional<double> length_of_near_path(const Index& index, Query& query, const Surface& surface,
                                          const SurfacePoint& source, const SurfacePoint& target,
                                          double known, size_t most_steps);

}
