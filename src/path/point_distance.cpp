#include "src/path/point_distance.h"

#include <algorithm>
#include <tuple>

#include "format/error.h"
#include "geoidx.h"
#include "src/path/path.h"

namespace geodesic {

namespace {

// An order of points, so that a path is always looked for from the same end.
bool is_before(const SurfacePoint& a, const SurfacePoint& b) {
    return std::tie(a.face, a.weights) < std::tie(b.face, b.weights);
}

// Infinite where no path is found, though the index knows a distance.
double straight_length(const Index& index, Query& query, const Surface& surface, const SurfacePoint& source,
                       const SurfacePoint& target) {
    try {
        return find_straight_path(index, query, surface, source, target).path.length;
    } catch (const Error& error) {
        if (error.status != GEOIDX_ERROR_NO_PATH) throw;
        return UNREACHABLE;
    }
}

}

float distance_of_points(const Index& index, Query& query, const Surface& surface, const SurfacePoint& source,
                         const SurfacePoint& target) {
    const bool is_turned = is_before(target, source);
    const SurfacePoint &first = is_turned ? target : source, &second = is_turned ? source : target;
    const PointQueries::Pair pair = PointQueries(index, query, surface).pair(first, second);
    if (pair.is_sure) return pair.distance;
    const auto walked = static_cast<float>(straight_length(index, query, surface, first, second));
    const float shortest = std::min(walked, pair.known_way);
    return shortest < INFINITE ? shortest : pair.distance;
}

}
