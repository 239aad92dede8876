#include "src/path/next_step.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "geoidx.h"
#include "src/path/exact_path.h"
#include "src/path/path.h"
#include "src/path/straighten.h"
#include "src/points/point_queries.h"
#include "src/surface/nearby.h"

namespace geodesic {

namespace {

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
// path stays as it is. Returns whether it does.
bool go_on_from(const Surface& surface, const StripPlace& place, StripWay& left) {
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
        left = straighten(surface, std::move(strip));
    return is_on_path;
}

// Whether a way is longer than the index says that the target is away, by more than most of its errors.
// From another point of a face that the path passes, the shortest way may leave over another edge.
bool is_detour(const Index& index, Query& query, const Surface& surface, const StripWay& way) {
    constexpr double ERROR = 0.01;
    const float distance = PointQueries(index, query, surface).sssd(way.strip.source, way.strip.target);
    return way.path.length > (1 + ERROR) * double{distance};
}

StripWay shorter(StripWay&& a, StripWay&& b) { return std::move(a.path.length <= b.path.length ? a : b); }

// The first piece of the path that is longer than 0: several portals may lie where it begins.
Step first_step(const Surface& surface, const StripWay& left) {
    const auto& [strip, path] = left;
    Step step{strip.source, strip.target, path.length};
    const Eigen::Vector3d begin = position_of(surface, strip.source);
    for (size_t i = 0; i < strip.portals.size(); ++i) {
        step.to = passed_point(surface, strip.faces[i], strip.portals[i], path.shares[i]);
        if (position_of(surface, step.to) != begin) return step;
        step.from = passed_point(surface, strip.faces[i + 1], strip.portals[i], path.shares[i]);
    }
    step.to = strip.target;
    return step;
}

// A point on a piece of a path, and the share of the piece that lies before it.
struct PiecePlace {
    SurfacePoint point; // of the face of the piece
    size_t piece;
    double share;
};

// Points between the ends of a piece are none of a path over vertices.
std::optional<PiecePlace> place_on_path(const Surface& surface, const SurfacePath& path,
                                        const SurfacePoint& point, bool is_over_vertices) {
    for (size_t i = 0; i < path.pieces.size(); ++i) {
        const auto at = point_in_face(surface, point, path.points[i].face);
        if (!at) continue;
        if (at->weights == path.points[i].weights) return PiecePlace{*at, i, 0};
        const Eigen::Vector3d begin = position_of(surface, path.points[i]),
                              end = position_of(surface, path.points[i + 1]),
                              here = position_of(surface, *at);
        if (is_over_vertices || here == end || !is_between(begin, here, end)) continue;
        return PiecePlace{*at, i, (here - begin).norm() / (end - begin).norm()};
    }
    return std::nullopt;
}

// Where a piece ends, as a point of its face.
SurfacePoint next_in_face(const Surface& surface, const SurfacePath& path, size_t piece) {
    return point_in_face(surface, path.points[piece + 1], path.points[piece].face).value();
}

// Steps along a path that stays as it was found. The pieces that were passed before are left behind.
Step step_on_path(const Index& index, Query& query, const Surface& surface, const SurfacePoint& from,
                  Walk& walk) {
    SurfacePath& path = walk.found;
    auto place = place_on_path(surface, path, from, index.description.metric != GEOIDX_METRIC_WEIGHTED);
    if (!place) {
        path = find_path(index, query, surface, from, walk.target, PathQuality::STRAIGHT);
        place = PiecePlace{path.points.front(), 0, 0};
    }
    // Where several points of the path lie at one place, the last of them has a direction.
    const auto position = [&](size_t i) { return position_of(surface, path.points[i]); };
    for (size_t i = place->piece; i + 1 < path.pieces.size() && place->share == 0; ++i) {
        if (position(i) != position(i + 1)) break;
        place = PiecePlace{path.points[i + 1], i + 1, 0};
    }
    double distance = -place->share * path.pieces[place->piece];
    for (size_t i = place->piece; i < path.pieces.size(); ++i) distance += path.pieces[i];
    const Step step{place->point, next_in_face(surface, path, place->piece), distance};
    const auto passed = static_cast<std::ptrdiff_t>(place->piece);
    path.points.erase(path.points.begin(), path.points.begin() + passed);
    path.pieces.erase(path.pieces.begin(), path.pieces.begin() + passed);
    path.length = std::accumulate(path.pieces.begin(), path.pieces.end(), 0.0);
    return step;
}

}

Step next_step(const Index& index, Query& query, const Surface& surface, const SurfacePoint& from,
               Walk& walk) {
    require_path_end(index, surface, from, "from");
    if (is_same_point(surface, walk.target, from)) return {from, from, 0};
    if (index.description.metric != GEOIDX_METRIC_EXACT)
        return step_on_path(index, query, surface, from, walk);
    StripWay left = std::exchange(walk.left, {}); // lost if memory runs out on the way
    const auto find = [&] { return find_straight_path(index, query, surface, from, walk.target); };
    if (const auto place = place_in_strip(surface, left.strip, from)) {
        if (!go_on_from(surface, *place, left) && is_detour(index, query, surface, left))
            left = shorter(std::move(left), find());
    } else {
        left = find();
    }
    const Step step = first_step(surface, left);
    walk.left = std::move(left);
    return step;
}

}
