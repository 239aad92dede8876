// The nearest of some points of a surface.
#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>
#include <vector>

#include "src/points/point_queries.h"

namespace geodesic {

namespace {

// A pair of points by tables takes about as long as a pair of vertices for every so many vertices of their
// polygons (`geoidx_bench paths`, which has some along paths among them).
constexpr uint64_t VERTICES_PER_PAIR = 5;

// No target is nearer than this share of the line in space to it. Answers of vertices may be a little shorter
// than that line.
constexpr double LEAST_SHARE_OF_LINE = 0.99;

// Each sweep looks this many times as far as the one before, or as the nearest vertex that it left out.
constexpr float GROWTH = 2;

// What is kept of a target: many may be given.
struct Target {
    uint32_t vertex; // the number of the vertex that it is at, or NONE
    std::array<uint32_t, 3> corners;
};

struct Targets {
    std::vector<Target> all;
    float reach = 0; // from a target to the corners of its face

    void add(const FacePoint& target) {
        all.push_back({target.vertex, target.corners()});
        for (size_t k = 0; k < 3; ++k) reach = std::max(reach, static_cast<float>(target.straight[k]));
    }
};

// Lower bounds of the distances of targets, in ascending order.
std::vector<Query::Found> least_possible(const Surface& surface, const SurfacePoint& source,
                                         std::span<const SurfacePoint> targets) {
    const Eigen::Vector3d place = position_of(surface, source);
    std::vector<Query::Found> least;
    least.reserve(targets.size());
    for (uint32_t i = 0; i < targets.size(); ++i) {
        const double line = (position_of(surface, targets[i]) - place).norm();
        least.push_back({static_cast<float>(LEAST_SHARE_OF_LINE * line), i});
    }
    std::ranges::sort(least);
    return least;
}

// The nearest of what is added, at most so many.
class Nearest {
public:
    explicit Nearest(size_t most) : most_(most) {}

    void add(const Query::Found& found) {
        found_.push_back(found);
        std::ranges::push_heap(found_);
        if (found_.size() <= most_) return;
        std::ranges::pop_heap(found_);
        found_.pop_back();
    }
    // What is farther is not kept; infinity as long as there is room.
    float limit() const { return found_.size() < most_ ? INFINITE : found_.front().distance; }
    std::vector<Query::Found> sorted() && {
        std::ranges::sort_heap(found_);
        return std::move(found_);
    }

private:
    size_t most_;
    std::vector<Query::Found> found_; // a heap
};

// Targets by the distances of the vertices around them, from the only one of the sources. The query, the
// targets and the arrays of the source outlive it.
class TargetSweeps {
public:
    TargetSweeps(Query& query, const PointSources& source, const Targets& targets)
        : query_(query), source_(source), targets_(targets) {}

    // Sweeps from the source until the `count` nearest targets are found, or nothing else can be reached;
    // looks at targets in the order of what they have in `least_possible`.
    // view_of(i) is what the i-th target sees. distance(i, view, by_vertices) is called for each target of
    // which all vertices have been found, with the distance that they give; it returns the one that counts.
    template <class ViewOf, class Distance>
    std::vector<Query::Found> find(size_t count, std::span<const Query::Found> least_possible,
                                   const ViewOf& view_of, const Distance& distance) {
        for (float radius = targets_.reach;;) {
            query_.sweep_within(source_, radius);
            Nearest nearest(count);
            // A target that is left out is no nearer: one of its corners is beyond the radius, or all tell
            // how near it can be.
            float left_out = radius - targets_.reach;
            for (const auto& [least, i] : least_possible) {
                if (least > nearest.limit()) break;
                if (!are_corners_found(targets_.all[i])) continue;
                const PointView view = view_of(i);
                const float by_vertices = distance_of(view.point);
                if (by_vertices == INFINITE)
                    left_out = std::min(left_out, least_by_corners(view.point));
                else if (const float answer = distance(i, view, by_vertices); answer < INFINITE)
                    nearest.add({answer, i});
            }
            const float beyond = query_.nearest_beyond();
            if (nearest.limit() <= left_out || beyond == INFINITE) return std::move(nearest).sorted();
            radius = std::max(radius, beyond) * GROWTH + targets_.reach;
        }
    }

private:
    bool is_found(uint32_t number) const { return query_.distance_within(number) < INFINITE; }

    bool are_corners_found(const Target& target) const {
        if (target.vertex != NONE) return is_found(target.vertex);
        return std::ranges::all_of(target.corners, [&](uint32_t corner) { return is_found(corner); });
    }

    // Infinite unless all vertices have been found. A point that is at a vertex has one.
    float distance_of(const FacePoint& point) const {
        if (point.vertex != NONE) return query_.distance_within(point.vertex);
        std::array<double, FacePoint::MOST_VERTICES> from_vertices;
        for (size_t k = 0; k < point.vertex_count; ++k) {
            from_vertices[k] = double{query_.distance_within(point.numbers[k])};
            if (!(from_vertices[k] < double{INFINITE})) return INFINITE;
        }
        return static_cast<float>(distance_over(point, from_vertices));
    }

    // No answer of distance_over() is less.
    float least_by_corners(const FacePoint& point) const {
        float least = 0;
        for (size_t k = 0; k < 3; ++k)
            least = std::max(least, query_.distance_within(point.numbers[k]) -
                                        static_cast<float>(point.straight[k]));
        return least;
    }

    Query& query_;
    const PointSources source_;
    const Targets& targets_;
};

}

std::vector<Query::Found> PointQueries::nearest_targets(const SurfacePoint& source,
                                                        std::span<const SurfacePoint> targets, size_t count,
                                                        const std::function<float(size_t)>& of_pair) {
    Targets faces;
    for (const SurfacePoint& target : targets) faces.add(face_point_on(index_, surface_, target, unfolds()));
    count = std::min(count, targets.size());
    if (count == 0) return {};
    const auto least = least_possible(surface_, source, targets);
    const uint64_t vertex_pairs_per_pair =
        most_vertices_of_polygon(surface_, surface_.faces[source.face]) / VERTICES_PER_PAIR;
    if (query_.targets_are_few(targets.size(), count, vertex_pairs_per_pair)) {
        Nearest nearest(count);
        for (const auto& [line, i] : least) {
            if (line > nearest.limit()) break;
            if (const float distance = of_pair(i); distance < INFINITE) nearest.add({distance, i});
        }
        return std::move(nearest).sorted();
    }
    const PointView from = view_of(source);
    const Sources only = sources_of({&source, 1}, {});
    TargetSweeps sweeps(query_, only, faces);
    std::unordered_map<uint32_t, float> of_pairs; // that were asked for, sweep by sweep
    return sweeps.find(
        count, least, [&](uint32_t i) { return view_of(targets[i]); },
        [&](uint32_t i, const PointView& to, float by_vertices) {
            if (from.point.vertex != NONE && to.point.vertex != NONE) return by_vertices;
            const WaysBetween ways = ways_between(source, from, targets[i], to, by_vertices);
            const float distance = ways.corrected(by_vertices);
            if (!needs_path(from.point, to.point, ways, distance)) return distance;
            const auto [asked, is_new] = of_pairs.try_emplace(i);
            if (is_new) asked->second = of_pair(i);
            return asked->second;
        });
}

}
