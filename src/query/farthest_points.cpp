#include <algorithm>
#include <array>

#include "src/query/query.h"

namespace geodesic {

namespace {

// Of vertices that have no id: no point is ever as near, and none is ever chosen.
constexpr float NEVER_CHOSEN = -1;

// Lowers each distance to that of a field, and returns where the largest one is, the first of equal ones.
// Each lane has a maximum of its own, so that compilers take several values at once.
size_t lower_to(std::span<const float> field, std::span<float> nearest) {
    constexpr size_t LANES = 16;
    std::array<float, LANES> largest;
    largest.fill(NEVER_CHOSEN);
    const size_t whole = nearest.size() / LANES * LANES;
    for (size_t i = 0; i < whole; i += LANES)
        for (size_t lane = 0; lane < LANES; ++lane) {
            nearest[i + lane] = std::min(nearest[i + lane], field[i + lane]);
            largest[lane] = std::max(largest[lane], nearest[i + lane]);
        }
    for (size_t i = whole; i < nearest.size(); ++i) {
        nearest[i] = std::min(nearest[i], field[i]);
        largest[0] = std::max(largest[0], nearest[i]);
    }
    return static_cast<size_t>(std::ranges::find(nearest, std::ranges::max(largest)) - nearest.begin());
}

}

// The next point has the largest distance of all. It lowers that of vertices that are nearer to it, so that a
// field as far as that distance tells all that it changes.
uint32_t Query::farthest_points(std::span<const uint32_t> source_ids, std::span<uint32_t> points,
                                std::span<float> distances) {
    take_sources(source_ids);
    const uint32_t vertices = index_.numbering().vertex_count();
    if (vertices == 0) return 0;
    const IdsOfNumbers& ids = ids_of_numbers();
    Array<float> nearest(vertices, NEVER_CHOSEN, distance_.get_allocator().resource());
    for (uint32_t number = 0; number < vertices; ++number)
        if (ids.first(number) != NONE) nearest[number] = INFINITE;
    size_t farthest =
        sources_.empty() ? lower_to(nearest, nearest) : lower_to(field_within(INFINITE), nearest);
    for (uint32_t found = 0; found < points.size(); ++found) {
        const float distance = nearest[farthest];
        if (!(distance > 0)) return found;
        points[found] = ids.first(static_cast<uint32_t>(farthest));
        if (!distances.empty()) distances[found] = distance;
        sources_.assign(1, static_cast<uint32_t>(farthest));
        farthest = lower_to(field_within(distance), nearest);
    }
    return static_cast<uint32_t>(points.size());
}

}
