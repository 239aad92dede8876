#pragma once

#include <functional>
#include <optional>

#include "src/path/strip.h"

namespace geodesic {

// Where a way over a surface of different costs leads, as a search is asked for it.
struct WeightedSearchRequest {
    SurfacePoint source, target;
    std::function<double(uint32_t)> distance_to_target; // of vertices
    uint32_t points_per_edge;
    // By how much those distances may be too long, since ways to points inside of faces lead over corners.
    double slack;
    // If it is finite, ways are left out whose length, with the distance to the target, is above it.
    double limit = UNREACHABLE;
};

// A way from one point to another in the graph of src/metric/weighted_surface.h: over vertices and evenly
// spaced points on every edge, joined straight through every face and along edges. Without a limit it is A*
// that leaves every point a few times at most, so that distances that are not quite right change the way but
// never make it endless. With one it is Dijkstra's algorithm, and the way the shortest of those within the
// limit. Portals of the strip may repeat: a way along an edge lies in the face there that costs least.
// Nothing if there is no way.
std::optional<StripWay> search_weighted(const Surface& surface, const WeightedSearchRequest& request);

}
