#pragma once

#include "src/path/surface_path.h"
#include "src/query/query.h"

namespace geodesic {

// Throws Error INVALID_ARGUMENT, with the point's name, where a path over vertices by the metric of the index
// cannot end at a point: metrics other than lengths of edges say nothing of what lies between vertices.
void require_vertex_path_end(const Index& index, const Surface& surface, const SurfacePoint& point,
                             const char* name);

// Finds a path that leads over vertices along edges, by the metrics that know no others: the shortest that A*
// finds by the distances of the index. An edge is as long as it costs, without costs as its length, and by
// the caller's own metric as the index says. Both ends must be such as are required above. Throws Error
// NO_PATH where there is none.
SurfacePath find_vertex_path(const Index& index, Query& query, const Surface& surface,
                             const SurfacePoint& source, const SurfacePoint& target);

}
