#include "src/points/point_queries.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include "format/error.h"
#include "geoidx.h"
#include "src/base/rounded.h"
#include "src/surface/indexed_faces.h"
#include "src/surface/nearby.h"

namespace geodesic {

namespace {

// What a point sees of the faces around it, whatever the index knows of them: twice as many vertices as its
// polygon has. Nothing is seen from a vertex, nor from a face that is too flat or that the index was not made
// on.
SeenAround see_around_any_leaf(const Surface& surface, const SurfacePoint& point) {
    const auto indexed = vertex_at(surface, point) == NONE ? indexed_point(surface, point) : std::nullopt;
    if (!indexed) return {};
    const size_t of_polygon = most_vertices_of_polygon(surface, indexed_corners(surface, indexed->face));
    return see_around(surface, *indexed, std::min(2 * of_polygon, FacePoint::MOST_VERTICES));
}

// Makes one of all ways from one source to the same vertex. Keeps them by numbers.
void merge_ways(std::vector<KnownWay>& ways) {
    std::ranges::sort(ways, {}, &KnownWay::number);
    auto end = ways.begin(); // of what is merged
    for (const KnownWay& way : ways) {
        if (end == ways.begin() || end[-1].number != way.number) {
            *end++ = way;
            continue;
        }
        end[-1].length = std::min(end[-1].length, way.length);
        end[-1].least = std::max(end[-1].least, way.least);
    }
    ways.erase(end, ways.end());
}

// Of the faces that a point lies in.
double longest_edge(const Surface& surface, const SurfacePoint& point) {
    double longest = 0;
    for_each_alias(surface, point, [&](const SurfacePoint& alias) {
        longest = std::max(longest, std::ranges::max(edge_lengths(surface, surface.faces[alias.face])));
    });
    return longest;
}

// Of the polygon of a point, unless it is at a vertex.
double longest_edge_around(const FacePoint& point) { return point.vertex == NONE ? point.longest_edge : 0; }

}

PointQueries::PointQueries(const Index& index, Query& query, const Surface& surface)
    : index_(index), query_(query), surface_(surface) {
    require_same_mesh(index, surface);
    const Description& about = index.description;
    const bool is_known = about.metric == GEOIDX_METRIC_EXACT || about.metric == GEOIDX_METRIC_EDGES;
    if (!is_known || about.metric_fingerprint != 0)
        refuse_argument("the metric of the index does not tell what a way within a triangle costs");
}

bool PointQueries::unfolds() const { return index_.description.metric == GEOIDX_METRIC_EXACT; }

PointView PointQueries::view_of(const SurfacePoint& point) const {
    return view_of(point, face_point_on(index_, surface_, point, unfolds()));
}

PointView PointQueries::view_of(const SurfacePoint& at, const FacePoint& point) const {
    return unfolds() ? view_from(index_, surface_, at, point) : PointView(point);
}

// No way is shorter than the straight line in space. The straight line over the faces counts even where
// tables, to their accuracy, say that there is a shorter way. Much shorter ways are there: around a needle
// that stands between two faces. Where a polygon has both points in it, a table's rounded distance says less.
// A way that is known besides is never left for a longer one.
float WaysBetween::corrected(float distance) const {
    constexpr float SHORTER = 0.99f, MUCH_SHORTER = 0.95f;
    if (is_shortest) return straight;
    if (!(distance < SHORTER * seen)) distance = seen;
    distance = std::max(std::min(distance, other), line);
    return distance < MUCH_SHORTER * straight ? distance : std::max(std::min(straight, other), line);
}

// What surface and views tell of a pair that is this far by tables.
WaysBetween PointQueries::ways_between(const SurfacePoint& source, const PointView& from,
                                       const SurfacePoint& target, const PointView& to,
                                       float distance) const {
    WaysBetween ways;
    if (is_same_point(surface_, source, target)) {
        ways.straight = 0;
        ways.is_shortest = true;
        return ways;
    }
    if (unfolds()) {
        ways.is_shortest = share_a_face(surface_, source, target);
        if (ways.is_shortest) {
            ways.straight =
                static_cast<float>((position_of(surface_, source) - position_of(surface_, target)).norm());
            return ways;
        }
        ways.straight = static_cast<float>(
            std::min(straight_nearby(surface_, source, target), straight_in_plane(surface_, source, target)));
        ways.seen = static_cast<float>(
            std::min(from.seen.straight_to(surface_, target), to.seen.straight_to(surface_, source)));
    }
    ways.line = static_cast<float>((position_of(surface_, source) - position_of(surface_, target)).norm());
    ways.other = static_cast<float>(way_around_corner(source, target));
    if (unfolds() && ways.seen == INFINITE && ways.straight == INFINITE)
        ways.other = std::min(ways.other, static_cast<float>(straight_way_of_near(
                                              source, target, std::min(distance, ways.other))));
    return ways;
}

// The length of a way around a corner that the faces of two points share, or over it. Tables of an index
// round what is far shorter than an edge, so that near a corner they say more.
double PointQueries::way_around_corner(const SurfacePoint& source, const SurfacePoint& target) const {
    return unfolds() ? std::min(over_any_corner(surface_, source, target),
                                straight_around_any_corner(surface_, source, target))
                     : over_corner(surface_, source, target);
}

// The length of the straight line between two points that are a few edges apart, so far as one of them, which
// is at no vertex, sees the other through faces of any leaf; infinite if there is none, or if they are
// farther apart. Near the ends of long edges, and at edges that three or more faces share, tables say little.
double PointQueries::straight_way_of_near(const SurfacePoint& source, const SurfacePoint& target,
                                          float distance) const {
    constexpr double NEAR_EDGES = 3;
    const double edge = std::min(longest_edge(surface_, source), longest_edge(surface_, target));
    if (!(double{distance} <= NEAR_EDGES * edge)) return UNREACHABLE;
    const auto seen_from = [&](const SurfacePoint& at, const SurfacePoint& other) {
        return see_around_any_leaf(surface_, at).faces.straight_to(surface_, other);
    };
    return std::min(seen_from(source, target), seen_from(target, source));
}

// Whether the distance that tables tell, with ways that are known besides, calls for a search for a path. A
// search asks for distances that points without tables, and the graph engine, have by whole fields only:
// there the distance has to do.
bool PointQueries::needs_path(const FacePoint& source, const FacePoint& target, const WaysBetween& ways,
                              float distance) const {
    constexpr double FEW_EDGES = 4;
    if (ways.is_shortest || distance == INFINITE || !source.has_tables() || !target.has_tables())
        return false;
    if (!unfolds() || std::holds_alternative<GraphIndex>(index_.engine)) return false;
    // Pairs of vertices that tables have wrong are measured, so that only edges around points that are at no
    // vertex count. Where these are short for the mesh, its average edge does, of which tables round to a
    // share: one patch may have several components.
    const double longest =
        std::max({longest_edge_around(source), longest_edge_around(target), surface_.average_edge});
    return double{distance} < FEW_EDGES * longest;
}

PointQueries::Pair PointQueries::pair(const SurfacePoint& source, const SurfacePoint& target) {
    FacePoint first = face_point_on(index_, surface_, source, unfolds()),
              second = face_point_on(index_, surface_, target, unfolds());
    if (first.vertex != NONE && second.vertex != NONE) return {query_.point_sssd(first, second)};
    const bool have_tables = first.has_tables() && second.has_tables();
    if (have_tables) share_leaf(index_, first, second);
    const PointView from = have_tables ? view_of(source, first) : PointView(first),
                    to = have_tables ? view_of(target, second) : PointView(second);
    const float by_tables = query_.point_sssd(from.point, to.point);
    const WaysBetween ways = ways_between(source, from, target, to, by_tables);
    const float distance = ways.corrected(by_tables);
    if (!needs_path(from.point, to.point, ways, distance)) return {distance};
    return {distance, true, ways.corrected(INFINITE)};
}

// To the corners of the face and, if the metric unfolds, to those of all faces that the point lies in, to the
// vertices beyond their edges and to others that the point sees: sums over tables are of rounded distances,
// which count where these are short, and the polygon that the index tells of ends at the border of a leaf. Of
// a vertex that the point does not see, what is known is the line in space.
void PointQueries::add_known_ways(const SurfacePoint& source, const SeenAround& around,
                                  std::vector<KnownWay>& known) const {
    const Eigen::Vector3d place = position_of(surface_, source);
    const auto add_way = [&](uint32_t vertex, double way) {
        const uint32_t number = number_of(vertex);
        if (number == NONE) return;
        const double chord = (surface_.positions[vertex] - place).norm();
        known.push_back({number, static_cast<float>(std::max(way, chord)), static_cast<float>(chord)});
    };
    const auto add = [&](const SurfacePoint& from, uint32_t vertex, uint32_t face) {
        add_way(vertex, straight_between(surface_, from, corner_point(surface_, face, vertex)));
    };
    if (!unfolds()) {
        for (const uint32_t corner : surface_.faces[source.face]) add(source, corner, source.face);
        return;
    }
    // Beyond an edge that the point lies on are others of its faces.
    for_each_alias(surface_, source, [&](const SurfacePoint& alias) {
        const auto& corners = surface_.faces[alias.face];
        for (uint32_t k = 0; k < 3; ++k) {
            add(alias, corners[k], alias.face);
            if (alias.weights[k] == 0) continue;
            const uint32_t a = corners[(k + 1) % 3], b = corners[(k + 2) % 3];
            for_each_face_beyond(surface_, alias.face, a, b, [&](uint32_t face) {
                for (const uint32_t vertex : surface_.faces[face])
                    if (vertex != a && vertex != b) add(alias, vertex, face);
            });
        }
    });
    for (uint32_t k = 0; k < around.vertex_count; ++k) add_way(around.vertices[k], around.straight[k]);
}

// Notes the vertices that the point sees and that are not of its polygon. The tables of the point's leaf tell
// of those of the polygon and, where edges are short, nearly as much of others in the leaf.
void PointQueries::add_beyond(const SurfacePoint& source, const SeenAround& around, FacePoint& point) const {
    const auto* const overlay = std::get_if<OverlayIndex>(&index_.engine);
    if (!overlay || point.leaf == NONE) return;
    const bool are_long = has_long_edges(surface_, surface_.faces[source.face]);
    const auto of_polygon = std::span(point.numbers).first(point.vertex_count);
    const auto is_known = [&](uint32_t number) {
        return are_long ? std::ranges::find(of_polygon, number) != of_polygon.end()
                        : is_in_leaf(overlay->numbering, point.leaf, number);
    };
    for (uint32_t k = 0; k < around.vertex_count; ++k) {
        const uint32_t number = number_of(around.vertices[k]);
        if (number != NONE && around.straight[k] < UNREACHABLE && !is_known(number))
            point.beyond[point.beyond_count++] = {number, around.straight[k]};
    }
}

// Tables have measured pairs wrong, so that fields from points near one vertex of such a pair have its other
// vertex wrong, too. What was measured differs from its distance by no more than the point is away from the
// first vertex, and by what a pair is rounded by. So vertices that are far from the point tell little: where
// these have very many pairs, the first ones of the polygon have to do.
void PointQueries::add_measured_ways(const FacePoint& point, std::vector<KnownWay>& known) const {
    constexpr size_t MOST_PAIRS = 512;
    const auto* const overlay = std::get_if<OverlayIndex>(&index_.engine);
    if (!overlay) return;
    const size_t most = known.size() + MOST_PAIRS;
    for (uint32_t k = 0; k < point.vertex_count; ++k) {
        if (point.straight[k] == UNREACHABLE) continue;
        for (const auto& [other, distance] : overlay->measured.of(point.numbers[k])) {
            if (known.size() == most) return;
            const auto apart = static_cast<float>(point.straight[k] + LARGEST_ROUNDING * double{distance});
            known.push_back({other, distance + apart, std::max(distance - apart, 0.f)});
        }
    }
}

PointQueries::Sources PointQueries::sources_of(std::span<const SurfacePoint> points,
                                               std::span<const float> offsets) const {
    Sources sources{{}, offsets, {}};
    sources.points.reserve(points.size());
    sources.known.reserve(points.size());
    for (const SurfacePoint& at : points) {
        FacePoint& point = sources.points.emplace_back(view_of(at).point);
        std::vector<KnownWay>& known = sources.known.emplace_back();
        if (point.vertex == NONE) {
            const SeenAround around = unfolds() ? see_around_any_leaf(surface_, at) : SeenAround();
            add_beyond(at, around, point);
            add_known_ways(at, around, known);
            add_measured_ways(point, known);
        } else {
            known.push_back({point.vertex, 0, 0});
        }
        merge_ways(known);
    }
    return sources;
}

void PointQueries::msad(std::span<const SurfacePoint> sources, std::span<const float> offsets,
                        std::span<float> distances) {
    query_.point_msad(sources_of(sources, offsets), distances);
}

void PointQueries::nearest_sources(std::span<const SurfacePoint> sources, std::span<const float> offsets,
                                   std::span<uint32_t> nearest, std::span<float> distances) {
    query_.point_nearest_sources(sources_of(sources, offsets), nearest, distances);
}

std::span<const Query::Found> PointQueries::within(std::span<const SurfacePoint> sources,
                                                   std::span<const float> offsets, float radius) {
    return query_.point_within(sources_of(sources, offsets), radius);
}

}
