#pragma once

#include <cstddef>
#include <optional>

#include "src/path/strip.h"
#include "src/path/surface_path.h"
#include "src/query/query.h"

// Paths by the exact metric: strips that the distances of an index lead to, straightened, and shortest ones
// in the corridor that these distances leave open.
namespace geodesic {

// A path between two points of which require_path_end() has been asked. Throws Error NO_PATH where there is
// none.
SurfacePath find_exact_path(const Index& index, Query& query, const Surface& surface,
                            const SurfacePoint& source, const SurfacePoint& target, PathQuality quality);

// One of STRAIGHT quality, with its strip.
StripWay find_straight_path(const Index& index, Query& query, const Surface& surface,
                            const SurfacePoint& source, const SurfacePoint& target);

// The length of a shortest path between near points, of which tables say that it is so long: of one of
// STRAIGHT quality or, if that is longer, of a shortest one in the corridor. Nothing where no strip is found
// in so many steps, or where the corridor is too large. Throws Error as PointQueries does, and
// INVALID_ARGUMENT where the index does not have all corners of a face.
std::optional<double> length_of_near_path(const Index& index, Query& query, const Surface& surface,
                                          const SurfacePoint& source, const SurfacePoint& target,
                                          double known, size_t most_steps);

}
