#include "src/points/seen_faces.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "src/base/plane.h"
#include "src/surface/indexed_faces.h"
#include "src/surface/nearby.h"
#include "src/surface/unfolded_vertex.h"

namespace geodesic {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A point has a polygon only in a face that is not flatter than this: its height as a share of its longest
// edge.
constexpr double FLATTEST = 1e-6;

// Directions between two that are less than half a turn apart.
bool is_in_angle(const Vector2d& right, const Vector2d& direction, const Vector2d& left) {
    return cross(right, direction) >= 0 && cross(direction, left) >= 0;
}

// An edge of a border has up to 31 added vertices: each of the builder's rounds cuts it in halves. One that
// had more than these would count as one that has none.
constexpr size_t MOST_BETWEEN = 64;

// An end of an edge of the polygon.
struct End : PlacedVertex {
    uint32_t slot; // among the vertices of the polygon
};

// One side of what the point sees of an edge: a direction of length 1, and whether it is that of the edge's
// end, which the point then sees.
struct Side {
    Vector2d direction;
    bool is_end;

    Side without_end() const { return {direction, false}; }
};

// An edge of the polygon. The point, which is the origin, sees `first` to the right of `second`, and of the
// edge what lies between two directions.
struct Edge {
    uint32_t behind; // a face on the other side of the edge; NONE if there are more than MOST_BEHIND
    bool is_copy;    // of an edge with another face behind it
    End first, second;
    Side right, left;

    Vector2d along() const { return second.at - first.at; }

    // The square of the chord of the angle that is seen.
    double width() const { return (right.direction - left.direction).squaredNorm(); }

    // How far from the first end the edge is met in a direction.
    double met_in(const Vector2d& direction) const {
        const double share = cross(first.at, direction) / cross(direction, along());
        return std::clamp(share, 0.0, 1.0) * along().norm();
    }
};

// A vertex that is seen in such a distance as a side of edges.
Side side_at(const Vector2d& place, double distance) {
    return {distance > 0 ? Vector2d(place / distance) : place, true};
}

// Knows all faces; the number of a vertex is the vertex itself.
class AllFaces final : public KnownFaces {
public:
    uint32_t number_of(uint32_t vertex) const override { return vertex; }
    bool go_on(uint32_t, uint32_t, double) const override { return true; }
    size_t find_between(uint32_t, uint32_t, double, std::span<VertexBetween>) const override { return 0; }
};

class Polygon {
public:
    Polygon(const Surface& surface, const KnownFaces& known, size_t most, FacePoint& point, SeenFaces& seen)
        : surface_(surface), known_(known), most_(most), point_(point), seen_(seen) {}

    // Begins with the face of the point. Returns false if it is too flat.
    bool begin(const SurfacePoint& at) {
        const auto& corners = indexed_corners(surface_, at.face);
        const Vector3d to_second = surface_.positions[corners[1]] - surface_.positions[corners[0]],
                       to_third = surface_.positions[corners[2]] - surface_.positions[corners[0]];
        const double longest = std::max({to_second.norm(), to_third.norm(), (to_third - to_second).norm()});
        if (!(to_second.cross(to_third).norm() > FLATTEST * longest * longest)) return false;
        const Vector3d x = to_second.normalized(), y = (to_third - x.dot(to_third) * x).normalized();
        const Vector3d origin =
            surface_.positions[corners[0]] + at.weights[1] * to_second + at.weights[2] * to_third;
        std::array<End, 3> ends;
        std::array<Side, 3> sides;
        for (uint32_t k = 0; k < 3; ++k) {
            const Vector3d to_corner = surface_.positions[corners[k]] - origin;
            ends[k] = {{corners[k], {x.dot(to_corner), y.dot(to_corner)}}, k};
            sides[k] = side_at(ends[k].at, ends[k].at.norm());
        }
        for (const FacePoint::Edge& edge : std::span(point_.edges).first(point_.edge_count))
            add(at.face, ends[edge.first], ends[edge.second], sides[edge.first], sides[edge.second]);
        return true;
    }

    // An edge gives way to two at most, and each of these comes MOST_BEHIND times at most.
    void grow() {
        while (point_.vertex_count < most_ && count_ + 2 * FacePoint::MOST_BEHIND <= edges_.size()) {
            const uint64_t key = widest_key();
            const auto index = static_cast<uint32_t>(key);
            if (key == key_of(0, index)) return;
            if (!unfold(index)) keys_[index] = key_of(0, index);
        }
    }

    // Nothing is unfolded behind a border, so that copies of its edges tell nothing more. An edge has no
    // length where vertices are at one position.
    void finish() {
        std::array<FacePoint::Edge, FacePoint::MOST_EDGES> whole;
        size_t count = 0, between = 0;
        point_.edge_count = 0;
        point_.longest_edge = 0;
        for (const Edge& edge : std::span(edges_).first(count_)) {
            const double length = edge.along().norm();
            point_.longest_edge = std::max(point_.longest_edge, length);
            if (!(length > 0) || (edge.is_copy && !goes_on(edge))) continue;
            whole[count] = whole_edge(edge, length);
            between += vertices_between(whole[count++]).size();
        }
        // Where there is no room for all vertices between the ends of edges, every second one of an edge is
        // taken, or every third one, and so on.
        const size_t room =
            std::min(FacePoint::MOST_VERTICES - point_.vertex_count, FacePoint::MOST_EDGES - count);
        const size_t step = between / (room + 1) + 1;
        for (const FacePoint::Edge& edge : std::span(whole).first(count))
            between == 0 ? add_part(edge, edge.first, edge.second, 0, edge.length) : add_parts(edge, step);
    }

private:
    // An edge by the width of its angle, for comparisons without jumps, which processors would mispredict.
    static uint64_t key_of(double width, size_t index) {
        return uint64_t{std::bit_cast<uint32_t>(static_cast<float>(width))} << 32 | index;
    }

    uint64_t widest_key() const {
        uint64_t key = 0;
        for (size_t i = 0; i < count_; ++i) key = std::max(key, keys_[i]);
        return key;
    }

    // Adds an edge of a face, once for each face behind it, so not where the surface ends.
    void add(uint32_t face, const End& first, const End& second, const Side& right, const Side& left) {
        std::array<uint32_t, FacePoint::MOST_BEHIND> behind;
        size_t count = 0;
        for_each_indexed_face_beyond(surface_, face, first.vertex, second.vertex, [&](uint32_t other) {
            if (count < behind.size()) behind[count] = other;
            ++count;
        });
        if (count > behind.size()) {
            count = 1;
            behind[0] = NONE;
        }
        bool is_copy = false;
        for (const uint32_t other : std::span(behind).first(count)) {
            edges_[count_] = {other, is_copy, first, second, right, left};
            keys_[count_] = key_of(edges_[count_].width(), count_);
            ++count_;
            is_copy = true;
        }
    }

    // Replaces an edge by what is seen of the two other edges of the face behind it. Returns false if that is
    // not known.
    bool unfold(size_t index) {
        const Edge edge = edges_[index];
        const uint32_t face = edge.behind;
        if (face == NONE || !goes_on(edge)) return false;
        const uint32_t apex = apex_beyond(face, edge);
        const uint32_t number = known_.number_of(apex);
        const Vector2d place = place_ahead(surface_, edge.second, edge.first, apex);
        const bool sees_first = cross(edge.right.direction, place) > 0,
                   sees_second = cross(place, edge.left.direction) > 0;
        if (number == NONE || !(sees_first || sees_second)) return false;
        const bool is_seen = sees_first && sees_second;
        const double distance = is_seen ? hypotenuse(place.x(), place.y()) : UNREACHABLE;
        const End third{{apex, place}, point_.vertex_count};
        point_.numbers[third.slot] = number;
        point_.straight[third.slot] = distance;
        ++point_.vertex_count;
        take_out(index);
        const Side right = is_seen ? side_at(place, distance) : edge.right.without_end(),
                   left = is_seen ? right : edge.left.without_end();
        if (sees_first) add(face, edge.first, third, edge.right, left);
        if (sees_second) add(face, third, edge.second, right, edge.left);
        note(face, edge, third);
        return true;
    }

    static FacePoint::Edge whole_edge(const Edge& edge, double length) {
        const Vector2d along = edge.along() / length;
        return {edge.first.slot,
                edge.second.slot,
                length,
                -along.dot(edge.first.at),
                std::max(cross(edge.first.at, along), 0.0),
                edge.right.is_end ? 0 : edge.met_in(edge.right.direction),
                edge.left.is_end ? length : edge.met_in(edge.left.direction)};
    }

    // They last until the next call.
    std::span<const VertexBetween> vertices_between(const FacePoint::Edge& whole) {
        const size_t count = known_.find_between(point_.numbers[whole.first], point_.numbers[whole.second],
                                                 whole.length, between_);
        return std::span(between_).first(count);
    }

    // Adds an edge of the polygon in the parts into which every step-th vertex between its ends divides it.
    void add_parts(const FacePoint::Edge& whole, size_t step) {
        const auto between = vertices_between(whole);
        uint32_t first = whole.first;
        double begin = 0;
        for (size_t i = step - 1; i < between.size(); i += step) {
            const uint32_t second = add_between(whole, between[i]);
            add_part(whole, first, second, begin, between[i].along);
            first = second;
            begin = between[i].along;
        }
        add_part(whole, first, whole.second, begin, whole.length);
    }

    // Returns the slot of a vertex that cuts an edge.
    uint32_t add_between(const FacePoint::Edge& whole, const VertexBetween& vertex) {
        const bool is_seen = whole.seen_from <= vertex.along && vertex.along <= whole.seen_to;
        const uint32_t slot = point_.vertex_count++;
        point_.numbers[slot] = vertex.number;
        point_.straight[slot] = is_seen ? hypotenuse(vertex.along - whole.foot, whole.height) : UNREACHABLE;
        return slot;
    }

    // What the point sees of an edge between two distances from its first end, if anything.
    void add_part(const FacePoint::Edge& whole, uint32_t first, uint32_t second, double begin, double end) {
        const double from = std::max(whole.seen_from, begin), to = std::min(whole.seen_to, end);
        if (from <= to && begin < end)
            point_.edges[point_.edge_count++] = {first,        second,       end - begin, whole.foot - begin,
                                                 whole.height, from - begin, to - begin};
    }

    bool goes_on(const Edge& edge) const {
        const auto& numbers = point_.numbers;
        return known_.go_on(numbers[edge.first.slot], numbers[edge.second.slot], edge.along().norm());
    }

    // The corner of the face behind an edge that is no end of it.
    uint32_t apex_beyond(uint32_t face, const Edge& edge) const {
        const auto& [a, b, c] = indexed_corners(surface_, face);
        const auto is_end = [&](uint32_t corner) {
            return corner == edge.first.vertex || corner == edge.second.vertex;
        };
        return !is_end(a) ? a : !is_end(b) ? b : c;
    }

    void take_out(size_t index) {
        edges_[index] = edges_[--count_];
        keys_[index] = keys_[count_] - count_ + index;
    }

    void note(uint32_t face, const Edge& edge, const End& third) {
        SeenFaces::Face& noted = seen_.faces[seen_.count++];
        noted.face = face;
        noted.right = edge.right.direction;
        noted.left = edge.left.direction;
        const auto& corners = indexed_corners(surface_, face);
        for (const End& end : {edge.first, edge.second, third})
            noted.corners[static_cast<size_t>(std::ranges::find(corners, end.vertex) - corners.begin())] =
                end.at;
    }

    const Surface& surface_;
    const KnownFaces& known_;
    const size_t most_; // of vertices
    FacePoint& point_;
    SeenFaces& seen_;
    size_t count_ = 0;
    std::array<Edge, FacePoint::MOST_EDGES> edges_;
    std::array<uint64_t, FacePoint::MOST_EDGES> keys_; // per edge, of width 0 where it cannot be unfolded
    std::array<VertexBetween, MOST_BETWEEN> between_;  // scratch
};

}

double SeenFaces::straight_to(const Surface& surface, const SurfacePoint& point) const {
    double least = UNREACHABLE;
    for_each_alias(surface, point, [&](const SurfacePoint& alias) {
        const auto indexed = indexed_point(surface, alias);
        if (!indexed) return;
        for (const Face& seen : std::span(faces).first(count)) {
            if (seen.face != indexed->face) continue;
            Vector2d at = Vector2d::Zero();
            for (size_t k = 0; k < 3; ++k) at += indexed->weights[k] * seen.corners[k];
            if (is_in_angle(seen.right, at, seen.left)) least = std::min(least, hypotenuse(at.x(), at.y()));
        }
    });
    return least;
}

void see_farther(const Surface& surface, const SurfacePoint& at, const KnownFaces& known, size_t most,
                 FacePoint& point, SeenFaces& seen) {
    Polygon polygon(surface, known, most, point, seen);
    if (!polygon.begin(at)) return;
    polygon.grow();
    polygon.finish();
}

SeenAround see_around(const Surface& surface, const SurfacePoint& at, size_t most) {
    const auto& corners = indexed_corners(surface, at.face);
    FacePoint polygon = face_point(corners, edge_lengths(surface, corners), at.weights, {true, true, true});
    SeenAround around;
    see_farther(surface, at, AllFaces(), most, polygon, around.faces);
    if (around.faces.count == 0) return around; // the corners alone, of a face that may be too flat
    around.vertex_count = polygon.vertex_count;
    std::copy_n(polygon.numbers.begin(), polygon.vertex_count, around.vertices.begin());
    std::copy_n(polygon.straight.begin(), polygon.vertex_count, around.straight.begin());
    return around;
}

size_t most_vertices_of_polygon(const Surface& surface, const std::array<uint32_t, 3>& corners) {
    constexpr uint32_t FEW_EDGES_ACROSS = 5;
    const double across = edges_across(surface, corners);
    if (across < FEW_EDGES_ACROSS) return 96;
    return are_long_edges(across) ? 32 : 16;
}

}
