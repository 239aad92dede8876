// The nearest of some points of a surface.
#include <algorithm>

#include "src/path/point_queries.h"

namespace geodesic {

namespace {

// A pair of points takes about as long as so many pairs of vertices (`geoidx_bench paths`).
constexpr uint64_t VERTEX_PAIRS_PER_PAIR = 3;

// Each sweep looks this many times as far as the one before, or as the nearest vertex that it left out.
constexpr float GROWTH = 2;

double longest_edge(std::span<const FacePoint> points) {
    double longest = 0;
    for (const FacePoint& point : points) longest = std::max(longest, std::ranges::max(point.edge_length));
    return longest;
}

// Targets by the distances of the vertices around them.
class TargetSweeps {
public:
    TargetSweeps(Query& query, const Query::PointSources& source, std::span<const FacePoint> targets)
        : query_(query), source_(source), targets_(targets),
          longest_edge_(static_cast<float>(longest_edge(targets))) {}

    // Sweeps until the `count` nearest targets are found, or nothing else can be reached. Calls
    // distance(i, by_corners) for each target of which all corners have been found, with the distance that
    // they give; it returns the one that counts.
    template <class Distance>
    std::vector<Query::Found> find(size_t count, const Distance& distance) {
        for (float radius = longest_edge_;;) {
            query_.sweep_within(source_, radius);
            std::vector<Query::Found> found;
            for (uint32_t i = 0; i < targets_.size(); ++i)
                if (const float by_corners = distance_of(i); by_corners < INFINITE)
                    found.push_back({distance(i, by_corners), i});
            std::ranges::sort(found);
            // A target that was left out has a corner beyond the radius, and is farther than the radius
            // less the longest edge of its triangle.
            const bool are_nearest =
                found.size() >= count && found[count - 1].distance <= radius - longest_edge_;
            const float beyond = query_.nearest_beyond();
            if (are_nearest || beyond == INFINITE) return found;
            radius = std::max(radius, beyond) * GROWTH + longest_edge_;
        }
    }

private:
    float distance_at(uint32_t number) const {
        float distance = query_.distance_within(number);
        for (const Query::KnownWay& way : source_.known)
            if (way.number == number) distance = std::min(distance, way.length);
        return distance;
    }

    // Infinite unless all corners have been found. A point that is at a vertex has one.
    float distance_of(uint32_t target) const {
        const FacePoint& point = targets_[target];
        if (point.vertex != NONE) return distance_at(point.vertex);
        std::array<double, 3> from_corners;
        for (size_t k = 0; k < 3; ++k) {
            from_corners[k] = double{distance_at(point.corners[k])};
            if (!(from_corners[k] < double{INFINITE})) return INFINITE;
        }
        return static_cast<float>(distance_over(point, from_corners));
    }

    Query& query_;
    const Query::PointSources& source_;
    std::span<const FacePoint> targets_;
    const float longest_edge_; // of the faces with targets
};

}

std::vector<Query::Found> PointQueries::nearest_targets(const SurfacePoint& source,
                                                        std::span<const SurfacePoint> targets, size_t count) {
    std::vector<FacePoint> to;
    for (const SurfacePoint& target : targets) to.push_back(face_point_of(target));
    count = std::min(count, targets.size());
    std::vector<Query::Found> found;
    if (count == 0) return found;
    if (query_.targets_are_few(targets.size(), count, VERTEX_PAIRS_PER_PAIR)) {
        for (uint32_t i = 0; i < targets.size(); ++i)
            if (const float distance = sssd(source, targets[i]); distance < INFINITE)
                found.push_back({distance, i});
        std::ranges::sort(found);
    } else {
        const Sources from = sources_of({&source, 1}, {});
        const Query::PointSources sources = from;
        found = TargetSweeps(query_, sources, to).find(count, [&](uint32_t i, float by_corners) {
            const bool are_vertices = from.points.front().vertex != NONE && to[i].vertex != NONE;
            return are_vertices ? by_corners : with_straight_way(source, targets[i], by_corners);
        });
    }
    found.resize(std::min(count, found.size()));
    return found;
}

}
