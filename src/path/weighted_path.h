#pragma once

#include "src/path/surface_path.h"
#include "src/query/query.h"

namespace geodesic {

// Finds a path between two points of a surface whose faces cost as they do in the index: led by the distances
// of the index from point to point of the edges, then made locally shortest. EXACT: also over as many points
// of each edge as the metric of the index has, where its distances allow a way about as short. Throws Error
// NO_PATH where there is none.
SurfacePath find_weighted_path(const Index& index, Query& query, const Surface& surface,
                               const SurfacePoint& source, const SurfacePoint& target, PathQuality quality);

}
