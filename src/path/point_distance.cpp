#include "src/path/point_distance.h"

#include <algorithm>
#include <tuple>

#include "src/path/exact_path.h"
#include "src/points/point_queries.h"

namespace geodesic {

namespace {

// An order of points, so that a path is always looked for from the same end.
bool is_before(const SurfacePoint& a, const SurfacePoint& b) {
    return std::tie(a.face, a.weights) < std::tie(b.face, b.weights);
}

}

// Where large triangles lie beside many small ones, a search may leave thousands of faces.
float distance_of_points(const Index& index, Query& query, const Surface& surface, const SurfacePoint& source,
                         const SurfacePoint& target) {
    constexpr size_t MOST_STEPS = 2000;
    const bool is_turned = is_before(target, source);
    const SurfacePoint &first = is_turned ? target : source, &second = is_turned ? source : target;
    const PointQueries::Pair pair = PointQueries(index, query, surface).pair(first, second);
    if (!pair.needs_path) return pair.distance;
    const auto length =
        length_of_near_path(index, query, surface, first, second, double{pair.distance}, MOST_STEPS);
    return length ? std::min(static_cast<float>(*length), pair.known_way) : pair.distance;
}

}
