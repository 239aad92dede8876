#include "src/path/next_step.h"

#include <algorithm>
#include <optional>

#include "src/path/nearby.h"
#include "src/path/straighten.h"

namespace geodesic {

namespace {

// The point as one of a face, if it lies in it.
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

// Goes on from a point of the strip, whose faces before that are left behind.
void go_on_from(const Surface& surface, const StripPlace& place, StraightPath& left) {
    auto& [strip, path] = left;
    const size_t passed = place.face;
    const bool is_on_path =
        passed > 0 &&
        point_at(surface, place.point.face, strip.portals[passed - 1], path.shares[passed - 1]).weights ==
            place.point.weights;
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

// The first piece of a path that has a length: several portals may lie where it begins.
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

// The same of a path that leads over vertices.
std::optional<Step> step_along(const Surface& surface, const std::vector<SurfacePoint>& points,
                               const SurfacePoint& from) {
    for (size_t i = 0; i + 1 < points.size(); ++i) {
        const auto at = point_in_face(surface, from, points[i].face);
        if (!at || at->weights != points[i].weights) continue;
        const auto to = point_in_face(surface, points[i + 1], points[i].face);
        if (!to) continue;
        double distance = 0;
        for (size_t k = i; k + 1 < points.size(); ++k)
            distance += (position_of(surface, points[k + 1]) - position_of(surface, points[k])).norm();
        return Step{*at, *to, distance};
    }
    return std::nullopt;
}

}

Step next_step(const Index& index, Query& query, const Surface& surface, const SurfacePoint& from,
               Walk& walk) {
    const PointQueries points(index, query, surface);
    const auto target = point_in_face(surface, walk.target, from.face);
    if (target && target->weights == from.weights) return {from, from, 0};
    if (!points.unfolds()) {
        if (const auto step = step_along(surface, walk.points, from)) return *step;
        walk.points = find_path(index, query, surface, from, walk.target, PathQuality::STRAIGHT).points;
        const auto step = step_along(surface, walk.points, from);
        return step ? *step : Step{from, from, 0};
    }
    if (const auto place = place_in_strip(surface, walk.left.strip, from))
        go_on_from(surface, *place, walk.left);
    else
        walk.left = find_straight_path(index, query, surface, from, walk.target);
    return first_step(surface, walk.left);
}

}
