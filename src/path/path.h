#pragma once

#include "src/path/surface_path.h"
#include "src/query/query.h"

namespace geodesic {

// Throws an Error where no path by the metric of the index can end at a point of the surface: MESH_MISMATCH
// where it is of another mesh, INVALID_ARGUMENT, with the point's name, where the surface lacks costs that
// the metric needs, where that has lengths of edges, which do not say how triangles lie, where it is one of a
// later version, or where paths end at vertices only and the point is none.
void require_path_end(const Index& index, const Surface& surface, const SurfacePoint& point,
                      const char* name);

// Finds a path between two points of a surface, led by the distances of an index. Throws Error as
// require_path_end does for each of them, and NO_PATH where there is none.
SurfacePath find_path(const Index& index, Query& query, const Surface& surface, const SurfacePoint& source,
                      const SurfacePoint& target, PathQuality quality);

}
