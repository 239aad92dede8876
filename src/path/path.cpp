#include "src/path/path.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "format/error.h"
#include "geoidx.h"
#include "src/path/corridor_path.h"
#include "src/path/nearby.h"
#include "src/path/search.h"
#include "src/path/sides.h"
#include "src/path/straighten.h"

namespace geodesic {

namespace {

[[noreturn]] void no_path() {
    throw Error(GEOIDX_ERROR_NO_PATH, "the two points are in different components of the surface");
}

bool is_at(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b) {
    return position_of(surface, a) == position_of(surface, b);
}

// Adds a point, but replaces one at the same place: the next piece lies in the face of the later one.
void add_point(const Surface& surface, const SurfacePoint& point, std::vector<SurfacePoint>& points) {
    if (!points.empty() && is_at(surface, points.back(), point)) points.pop_back();
    points.push_back(point);
}

SurfacePath path_of_points(const Surface& surface, std::vector<SurfacePoint>&& points,
                           const SurfacePoint& target) {
    if (points.size() < 2) points.push_back(target);
    double length = 0;
    for (size_t i = 1; i < points.size(); ++i)
        length += (position_of(surface, points[i]) - position_of(surface, points[i - 1])).norm();
    return {std::move(points), length};
}

SurfacePath path_of_strip(const Surface& surface, const Strip& strip, const StripPath& path) {
    std::vector<SurfacePoint> points{strip.source};
    for (size_t i = 0; i < strip.portals.size(); ++i)
        add_point(surface, point_at(surface, strip.faces[i + 1], strip.portals[i], path.shares[i]), points);
    add_point(surface, strip.target, points);
    return path_of_points(surface, std::move(points), strip.target);
}

// Each vertex as a point of a face that it shares with the next one.
SurfacePath path_of_vertices(const Surface& surface, const SurfacePoint& source,
                             const std::vector<uint32_t>& vertices, const SurfacePoint& target) {
    std::vector<SurfacePoint> points{source};
    for (size_t i = 0; i < vertices.size(); ++i) {
        uint32_t face = target.face;
        if (i + 1 < vertices.size())
            face = *std::ranges::find_if(surface.vertex_faces[vertices[i]], [&](uint32_t f) {
                return corner_of(surface, f, vertices[i + 1]) != NONE;
            });
        add_point(surface, point_at(surface, face, {vertices[i], vertices[i]}, 0), points);
    }
    add_point(surface, target, points);
    return path_of_points(surface, std::move(points), target);
}

class PathFinder {
public:
    PathFinder(const Index& index, Query& query, const Surface& surface, const SurfacePoint& source,
               const SurfacePoint& target)
        : index_(index), query_(query), surface_(surface), points_(index, query, surface), source_(source),
          target_(target) {}

    SurfacePath find(PathQuality quality);
    StraightPath find_straight();

private:
    double distance(size_t end, uint32_t vertex) {
        const uint32_t number = points_.number_of(vertex);
        return number == NONE ? UNREACHABLE : double{query_.end_distance(end, number)};
    }
    TargetDistances distances_from(size_t end) {
        return {[this, end](uint32_t vertex) { return distance(end, vertex); }, {}};
    }
    std::optional<StraightPath> led_by(size_t end);
    double least_distance(double distance) const;
    bool belongs(uint32_t vertex, double slack, double length);

    const Index& index_;
    Query& query_;
    const Surface& surface_;
    PointQueries points_;
    const SurfacePoint source_, target_;
};

// The least that a distance can be of which the index says this, by the largest errors that it states.
double PathFinder::least_distance(double distance) const {
    constexpr double LEAST_ERROR = 1e-3;
    const size_t of_class = distance_class(distance / surface_.average_edge);
    return distance / (1 + std::max(LEAST_ERROR, index_.description.error.by_distance[of_class].max));
}

// Vertices over which there may be a way that is no longer than the path, but for the width of a face.
bool PathFinder::belongs(uint32_t vertex, double slack, double length) {
    return least_distance(distance(0, vertex)) + least_distance(distance(1, vertex)) <= length + slack;
}

// Led by the distances from one end, from the other one on.
std::optional<StraightPath> PathFinder::led_by(size_t end) {
    const TargetDistances distances = distances_from(end);
    auto strip = end == 1 ? search_strip(surface_, source_, target_, distances)
                          : search_strip(surface_, target_, source_, distances);
    if (!strip) return std::nullopt;
    if (end == 0) turn_back(*strip);
    StripPath path = straighten(surface_, *strip);
    return StraightPath{std::move(*strip), std::move(path)};
}

// The errors of the two fields may lead to different ways around a bump.
StraightPath PathFinder::find_straight() {
    constexpr double SAME = 1e-9; // lengths of one way, as a share
    query_.prepare_end(1, points_.face_point_of(target_));
    query_.prepare_end(0, points_.face_point_of(source_));
    auto one = led_by(1);
    if (!one) no_path();
    auto other = led_by(0);
    if (!other || std::abs(one->path.length - other->path.length) <= SAME * one->path.length)
        other = std::nullopt;
    for (auto* found : {&one, &other})
        if (*found) try_other_sides(surface_, (*found)->strip, (*found)->path);
    return std::move(other && other->path.length < one->path.length ? *other : *one);
}

SurfacePath PathFinder::find(PathQuality quality) {
    if (is_at(surface_, source_, target_) && points_.sssd(source_, target_) == 0)
        return path_of_points(surface_, {source_}, target_);
    if (!points_.unfolds()) {
        query_.prepare_end(1, points_.face_point_of(target_));
        const TargetDistances distances = distances_from(1);
        const auto vertices = search_edges(surface_, source_, target_, distances);
        if (!vertices) no_path();
        return path_of_vertices(surface_, source_, *vertices, target_);
    }
    auto [strip, path] = find_straight();
    if (quality == PathQuality::EXACT && strip.faces.size() > 1) {
        const Corridor corridor =
            corridor_around(surface_, strip, [&, length = path.length](uint32_t vertex, double slack) {
                return belongs(vertex, slack, length);
            });
        make_shortest_in_corridor(surface_, corridor, strip, path);
    }
    return path_of_strip(surface_, strip, path);
}

}

SurfacePath find_path(const Index& index, Query& query, const Surface& surface, const SurfacePoint& source,
                      const SurfacePoint& target, PathQuality quality) {
    return PathFinder(index, query, surface, source, target).find(quality);
}

StraightPath find_straight_path(const Index& index, Query& query, const Surface& surface,
                                const SurfacePoint& source, const SurfacePoint& target) {
    return PathFinder(index, query, surface, source, target).find_straight();
}

}
