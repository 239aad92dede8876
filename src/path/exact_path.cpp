#include "src/path/exact_path.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "src/path/corridor_path.h"
#include "src/path/sides.h"
#include "src/path/straighten.h"
#include "src/path/strip_search.h"
#include "src/points/face_points.h"
#include "src/points/point_queries.h"
#include "src/surface/indexed_faces.h"
#include "src/surface/nearby.h"

namespace geodesic {

namespace {

SurfacePath path_of_strip(const Surface& surface, const Strip& strip, const StripPath& path) {
    std::vector<SurfacePoint> points;
    points.reserve(strip.portals.size() + 2);
    points.push_back(strip.source);
    for (size_t i = 0; i < strip.portals.size(); ++i)
        add_point(surface, passed_point(surface, strip.faces[i + 1], strip.portals[i], path.shares[i]),
                  points);
    add_point(surface, strip.target, points);
    return path_of_points(std::move(points), strip.target,
                          [&](const auto& all, size_t i) { return distance_to_next(surface, all, i); });
}

class PathFinder {
public:
    // A strip that takes more steps than that is given up.
    PathFinder(const Index& index, Query& query, const Surface& surface, const SurfacePoint& source,
               const SurfacePoint& target, size_t most_steps = SIZE_MAX)
        : index_(index), query_(query), surface_(surface), points_(index, query, surface), source_(source),
          target_(target), search_(surface), most_steps_(most_steps) {}

    StripWay find_way(PathQuality quality);
    SurfacePath find(PathQuality quality);
    std::optional<double> find_length(double known);

private:
    // Of a corridor that is no exact path's.
    static constexpr size_t MOST_VERTICES = 1000, MOST_FACES = 2 * MOST_VERTICES;

    FacePoint prepared_as(const SurfacePoint& end, bool with_all_it_sees) const;
    std::optional<StripWay> find_straight(const FacePoint& source, const FacePoint& target);
    double longest_shortest(double known) const;
    double known_length(const FacePoint& target);
    std::optional<Corridor> corridor_of(const Strip& strip, double length, size_t most_vertices);
    double distance(size_t end, uint32_t vertex) {
        return end_distance(index_, query_, surface_, end, vertex);
    }
    TargetDistances distances_from(size_t end) {
        constexpr double ERROR = 0.005; // of most distances of most indexes
        return {[this, end](uint32_t vertex) { return distance(end, vertex); }, ERROR, most_steps_};
    }
    std::optional<Strip> led_by(size_t end);
    double least_distance(double distance) const;
    bool belongs(uint32_t vertex, double slack, double length);

    const Index& index_;
    Query& query_;
    const Surface& surface_;
    PointQueries points_;
    const SurfacePoint source_, target_;
    StripSearch search_;
    const size_t most_steps_;
};

// The least that a distance can be of which the index says this, by the largest errors that it states. These
// are of vertices, which have measured pairs; a path asks for distances from its ends by tables alone.
double PathFinder::least_distance(double distance) const {
    constexpr double LEAST_ERROR = 1e-3;
    const size_t of_class = distance_class(distance / surface_.average_edge);
    const double stated = index_.description.error.by_distance[of_class].max;
    return distance / (1 + std::max({LEAST_ERROR, stated, error_of_measured_pairs(index_, of_class)}));
}

// What the query knows of an end. Where faces are small for what the surface does, the corners of its face
// mostly lead to the same strips as all that it sees, and a path between near points takes a quarter less
// time. A corridor is as wide as errors may be, so that the less they are the better.
FacePoint PathFinder::prepared_as(const SurfacePoint& end, bool with_all_it_sees) const {
    constexpr double RIGHT = 5e-4; // mean error
    const bool has_large_faces = index_.description.error.mean > RIGHT || surface_.flat_faces.has(end.face);
    if (with_all_it_sees || has_large_faces) return points_.view_of(end).point;
    return face_point_on(index_, surface_, end, points_.unfolds());
}

// Vertices over which there may be a way that is no longer than the path, but for the width of a face.
bool PathFinder::belongs(uint32_t vertex, double slack, double length) {
    return least_distance(distance(0, vertex)) + least_distance(distance(1, vertex)) <= length + slack;
}

// Led by the distances from one end, from the other one on; the strip leads from source to target.
std::optional<Strip> PathFinder::led_by(size_t end) {
    const TargetDistances distances = distances_from(end);
    if (end == 1) return search_.run(source_, target_, distances);
    auto strip = search_.run(target_, source_, distances);
    if (strip) turn_back(*strip);
    return strip;
}

// The errors of the two fields may lead to different ways around a bump. The longer one is given up where it
// is the same way, or longer by more than other sides of vertices nearly ever make up for. Nothing if neither
// field leads to the other end.
std::optional<StripWay> PathFinder::find_straight(const FacePoint& source, const FacePoint& target) {
    constexpr double SAME = 1e-9;        // as a share of the length
    constexpr double MADE_UP_FOR = 0.02; // as a share of an edge
    const auto length = [](const StripWay& way) { return way.path.length; };
    query_.prepare_end(1, target);
    query_.prepare_end(0, source);
    std::vector<Strip> strips;
    for (const size_t end : {size_t{1}, size_t{0}})
        if (auto strip = led_by(end)) strips.push_back(std::move(*strip));
    if (strips.empty()) return std::nullopt;
    if (is_same_strip(strips.front(), strips.back())) strips.resize(1);
    Straightening straightening(surface_);
    std::vector<StripWay> ways;
    for (Strip& strip : strips) {
        if (!ways.empty() && is_same_strip(strip, ways.front().strip)) break; // as the first one came out
        ways.push_back({std::move(strip), {}});
        straightening.straighten(ways.back());
    }
    std::ranges::sort(ways, {}, length);
    const double longer = length(ways.back()) - length(ways.front());
    const double edge = surface_.components.of(surface_.faces[source_.face][0]).average_edge;
    if (longer <= SAME * length(ways.front()) || longer > MADE_UP_FOR * edge) ways.resize(1);
    try_other_sides(surface_, ways);
    return std::move(*std::ranges::min_element(ways, {}, length));
}

// How long a shortest path is at most of which the index says that it is so long, but for one of a hundred
// distances that err by more.
double PathFinder::longest_shortest(double known) const {
    constexpr double LEAST_ERROR = 1e-3;
    return known * (1 + std::max(index_.description.error.p99, LEAST_ERROR));
}

// As the field of the source has it.
double PathFinder::known_length(const FacePoint& target) {
    std::array<double, FacePoint::MOST_VERTICES> from_vertices;
    for (size_t k = 0; k < target.vertex_count; ++k)
        from_vertices[k] = double{query_.end_distance(0, target.numbers[k])};
    return distance_over(target, from_vertices);
}

// The corridor of paths up to this length, unless it has too many vertices.
std::optional<Corridor> PathFinder::corridor_of(const Strip& strip, double length, size_t most_vertices) {
    size_t count = 0;
    Corridor corridor = corridor_around(surface_, strip, [&](uint32_t vertex, double slack) {
        const bool is_one = count <= most_vertices && belongs(vertex, slack, length);
        count += is_one;
        return is_one;
    });
    if (count > most_vertices) return std::nullopt;
    return corridor;
}

// There are surfaces of so many bumps that straight ways are not among the shortest ones. There, too, a
// corridor is searched.
StripWay PathFinder::find_way(PathQuality quality) {
    const auto lies_in_long_edges = [&](const SurfacePoint& end) {
        return has_long_edges(surface_, surface_.faces[end.face]);
    };
    const bool with_all_they_see =
        quality == PathQuality::EXACT || lies_in_long_edges(source_) || lies_in_long_edges(target_);
    const FacePoint source = prepared_as(source_, with_all_they_see),
                    target = prepared_as(target_, with_all_they_see);
    auto found = find_straight(source, target);
    if (!found) no_path();
    StripWay way = std::move(*found);
    if (way.strip.faces.size() == 1) return way;
    if (quality == PathQuality::EXACT) {
        const auto corridor = corridor_of(way.strip, way.path.length, surface_.vertex_count());
        make_shortest_in_corridor(surface_, *corridor, way.strip, way.path);
        return way;
    }
    const double length = longest_shortest(known_length(target));
    if (way.path.length <= length) return way;
    if (const auto corridor = corridor_of(way.strip, length, MOST_VERTICES))
        make_shortest_in_corridor(surface_, *corridor, way.strip, way.path);
    return way;
}

// The length of a straight path or, if the pair is known to be shorter, of a shortest one in the corridor. Of
// the pair more is known than what its ends see would tell. Distances of edges' ends may tell of a short way
// that is not there, as between the two sides of a thin wall: then edges are long, so that the corridor is
// too large, whereas few faces lie so near in space. Returns nothing if there are too many of these as well.
std::optional<double> PathFinder::find_length(double known) {
    const auto way = find_straight(prepared_as(source_, false), prepared_as(target_, false));
    if (!way) return std::nullopt;
    const double length = longest_shortest(known);
    if (way->strip.faces.size() == 1 || way->path.length <= length) return way->path.length;
    auto corridor = corridor_of(way->strip, length, MOST_VERTICES);
    if (!corridor) corridor = corridor_in_space(surface_, way->strip, length, MOST_FACES);
    if (!corridor) return std::nullopt;
    return std::min(way->path.length, shortest_length_in_corridor(*corridor, way->strip));
}

SurfacePath PathFinder::find(PathQuality quality) {
    if (is_same_point(surface_, source_, target_)) return path_within_point(source_, target_);
    const StripWay way = find_way(quality);
    return path_of_strip(surface_, way.strip, way.path);
}

}

SurfacePath find_exact_path(const Index& index, Query& query, const Surface& surface,
                            const SurfacePoint& source, const SurfacePoint& target, PathQuality quality) {
    return PathFinder(index, query, surface, source, target).find(quality);
}

StripWay find_straight_path(const Index& index, Query& query, const Surface& surface,
                            const SurfacePoint& source, const SurfacePoint& target) {
    return PathFinder(index, query, surface, source, target).find_way(PathQuality::STRAIGHT);
}

std::optional<double> length_of_near_path(const Index& index, Query& query, const Surface& surface,
                                          const SurfacePoint& source, const SurfacePoint& target,
                                          double known, size_t most_steps) {
    return PathFinder(index, query, surface, source, target, most_steps).find_length(known);
}

}
