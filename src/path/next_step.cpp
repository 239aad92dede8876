#include "src/path/next_step.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "src/path/nearby.h"
#include "src/path/straighten.h"

namespace geodesic {

namespace {

// The point with the weights of a face, if it lies in that face.
std::optional<SurfacePoint> point_in_face(const Surface& surface, const SurfacePoint& point, uint32_t face) {
    std::optional<SurfacePoint> found;
    for_each_alias(surface, point, [&](const SurfacePoint& alias) {
        if (alias.face == face) found = alias;
    });
    return found;
}

// Where a point lies in a strip: the last face that it is a point of.
struct StripPlace {
    size_t face;
    SurfacePoint point; // of that face
};
std::optional<StripPlace> place_in_strip(const Surface& surface, const Strip& strip,
                                         const SurfacePoint& point) {
    std::vector<SurfacePoint> aliases;
    for_each_alias(surface, point, [&](const SurfacePoint& alias) { aliases.push_back(alias); });
    for (size_t i = strip.faces.size(); i-- > 0;)
        if (const auto alias = std::ranges::find(aliases, strip.faces[i], &SurfacePoint::face);
            alias != aliases.end())
            return StripPlace{i, *alias};
    return std::nullopt;
}

// Whether a point lies on the straight line between two others, but for rounding.
bool is_between(const Eigen::Vector3d& begin, const Eigen::Vector3d& at, const Eigen::Vector3d& end) {
    constexpr double ROUNDING = 1e-12;
    return (at - begin).norm() + (end - at).norm() <= (1 + ROUNDING) * (end - begin).norm();
}

// Makes the path begin at a point of the strip, and drops the faces before it. From a point on the path the
// path stays as it is.
void go_on_from(const Surface& surface, const StripPlace& place, StraightPath& left) {
    auto& [strip, path] = left;
    const size_t passed = place.face;
    const Eigen::Vector3d end = passed < strip.portals.size()
                                    ? position_at(surface, strip.portals[passed], path.shares[passed])
                                    : position_of(surface, strip.target);
    const bool is_on_path =
        is_between(position_before(surface, strip, path, passed), position_of(surface, place.point), end);
    strip.source = place.point;
    const auto leave_behind = [&](auto& passed_ones) {
        passed_ones.erase(passed_ones.begin(), passed_ones.begin() + static_cast<std::ptrdiff_t>(passed));
    };
    leave_behind(strip.faces);
    leave_behind(strip.portals);
    leave_behind(path.shares);
    if (is_on_path)
        path.length = length_of(surface, strip, path.shares);
    else
        path = straighten(surface, strip);
}

// The first piece of the path that is longer than 0: several portals may lie where it begins.
Step first_step(const Surface& surface, const StraightPath& left) {
    const auto& [strip, path] = left;
    Step step{strip.source, strip.target, path.length};
    const Eigen::Vector3d begin = position_of(surface, strip.source);
    for (size_t i = 0; i < strip.portals.size(); ++i) {
        step.to = point_at(surface, strip.faces[i], strip.portals[i], path.shares[i]);
        if (position_of(surface, step.to) != begin) return step;
        step.from = point_at(surface, strip.faces[i + 1], strip.portals[i], path.shares[i]);
    }
    step.to = strip.target;
    return step;
}

// The step from one of the points of a path that leads over vertices to the next one.
Step step_from(const Surface& surface, const std::vector<SurfacePoint>& points, size_t i) {
    double distance = 0;
    for (size_t k = i; k + 1 < points.size(); ++k)
        distance += (position_of(surface, points[k + 1]) - position_of(surface, points[k])).norm();
    return {points[i], point_in_face(surface, points[i + 1], points[i].face).value(), distance};
}

// Where the metric does not unfold. The points that were passed before are left behind.
Step step_over_vertices(const Index& index, Query& query, const Surface& surface, const SurfacePoint& from,
                        Walk& walk) {
    std::vector<SurfacePoint>& points = walk.points;
    for (size_t i = 0; i + 1 < points.size(); ++i) {
        const auto at = point_in_face(surface, from, points[i].face);
        if (!at || at->weights != points[i].weights) continue;
        points.erase(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(i));
        return step_from(surface, points, 0);
    }
    points = find_path(index, query, surface, from, walk.target, PathQuality::STRAIGHT).points;
    return step_from(surface, points, 0);
}

}

Step next_step(const Index& index, Query& query, const Surface& surface, const SurfacePoint& from,
               Walk& walk) {
    const PointQueries points(index, query, surface);
    const auto target = point_in_face(surface, walk.target, from.face);
    if (target && target->weights == from.weights) return {from, from, 0};
    if (!points.unfolds()) return step_over_vertices(index, query, surface, from, walk);
    StraightPath left = std::exchange(walk.left, {}); // lost if memory runs out on the way
    if (const auto place = place_in_strip(surface, left.strip, from))
        go_on_from(surface, *place, left);
    else
        left = find_straight_path(index, query, surface, from, walk.target);
    const Step step = first_step(surface, left);
    walk.left = std::move(left);
    return step;
}

}
