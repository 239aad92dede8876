#include "src/points/seen_faces.h"

#include <algorithm>
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

// The square of the chord of an angle.
double width_of(const Vector2d& right, const Vector2d& left) {
    return (right.normalized() - left.normalized()).squaredNorm();
}

// Directions between two that are less than half a turn apart.
bool is_in_angle(const Vector2d& right, const Vector2d& direction, const Vector2d& left) {
    return cross(right, direction) >= 0 && cross(direction, left) >= 0;
}

// An end of an edge of the polygon.
struct End : PlacedVertex {
    uint32_t slot; // among the vertices of the polygon
};

// An edge of the polygon. The point, which is the origin, sees `first` to the right of `second`, and of the
// edge what lies between two directions.
struct Edge {
    uint32_t behind; // the face on the other side of the edge; NONE if there are several
    End first, second;
    Vector2d right, left;
    double width; // of the angle that is seen; 0 where nothing behind the edge can be unfolded

    double length() const { return (second.at - first.at).norm(); }
    Vector2d along() const { return (second.at - first.at).normalized(); }

    // How far from the first end the edge is met in a direction.
    double met_in(const Vector2d& direction) const {
        const double share = cross(first.at, direction) / cross(direction, second.at - first.at);
        return std::clamp(share, 0.0, 1.0) * length();
    }
};

class Polygon {
public:
    Polygon(const Surface& surface, const KnownFaces& known, FacePoint& point, SeenFaces& seen)
        : surface_(surface), known_(known), point_(point), seen_(seen) {}

    // Begins with the face of the point. Returns false if it is too flat.
    bool begin(const SurfacePoint& at) {
        const auto& corners = indexed_corners(surface_, at.face);
        const Vector3d to_second = surface_.positions[corners[1]] - surface_.positions[corners[0]],
                       to_third = surface_.positions[corners[2]] - surface_.positions[corners[0]];
        const Vector3d x = to_second.normalized();
        const Vector3d off = to_third - x.dot(to_third) * x, y = off.normalized();
        if (!(off.norm() > FLATTEST * std::max(to_second.norm(), to_third.norm()))) return false;
        const Vector3d origin =
            surface_.positions[corners[0]] + at.weights[1] * to_second + at.weights[2] * to_third;
        std::array<End, 3> ends;
        for (uint32_t k = 0; k < 3; ++k) {
            const Vector3d to_corner = surface_.positions[corners[k]] - origin;
            ends[k] = {{corners[k], {x.dot(to_corner), y.dot(to_corner)}}, k};
        }
        for (const FacePoint::Edge& edge : std::span(point_.edges).first(point_.edge_count))
            add(at.face, ends[edge.first], ends[edge.second], ends[edge.first].at, ends[edge.second].at);
        return true;
    }

    // An edge gives way to two at most.
    void grow() {
        while (point_.vertex_count < FacePoint::MOST_VERTICES && count_ < FacePoint::MOST_EDGES) {
            Edge* const begin = edges_.data();
            Edge* const widest = std::max_element(
                begin, begin + count_, [](const Edge& a, const Edge& b) { return a.width < b.width; });
            if (count_ == 0 || !(widest->width > 0)) return;
            if (!unfold(*widest)) widest->width = 0;
        }
    }

    // An edge has no length where vertices are at one position.
    void finish() {
        point_.edge_count = 0;
        for (const Edge& edge : std::span(edges_).first(count_)) {
            const Vector2d along = edge.along();
            const double length = edge.length();
            if (!(length > 0)) continue;
            point_.edges[point_.edge_count++] = {edge.first.slot,
                                                 edge.second.slot,
                                                 length,
                                                 -along.dot(edge.first.at),
                                                 std::max(cross(edge.first.at, along), 0.0),
                                                 edge.right == edge.first.at ? 0 : edge.met_in(edge.right),
                                                 edge.left == edge.second.at ? length
                                                                             : edge.met_in(edge.left)};
        }
    }

private:
    // Adds an edge of a face, unless the surface ends there.
    void add(uint32_t face, const End& first, const End& second, const Vector2d& right,
             const Vector2d& left) {
        uint32_t behind = NONE, count = 0;
        for_each_indexed_face_beyond(surface_, face, first.vertex, second.vertex, [&](uint32_t other) {
            behind = other;
            ++count;
        });
        if (count > 0)
            edges_[count_++] = {count == 1 ? behind : NONE, first, second, right, left,
                                width_of(right, left)};
    }

    // Replaces an edge by what is seen of the two other edges of the face behind it. Returns false if that is
    // not known.
    bool unfold(Edge& at) {
        const Edge edge = at;
        const uint32_t face = edge.behind;
        const auto& numbers = point_.numbers;
        if (face == NONE || !known_.go_on(numbers[edge.first.slot], numbers[edge.second.slot], edge.length()))
            return false;
        const auto& corners = indexed_corners(surface_, face);
        const uint32_t apex = *std::ranges::find_if(corners, [&](uint32_t corner) {
            return corner != edge.first.vertex && corner != edge.second.vertex;
        });
        const uint32_t number = known_.number_of(apex);
        const Vector2d place = place_ahead(surface_, edge.second, edge.first, apex);
        const bool sees_first = cross(edge.right, place) > 0, sees_second = cross(place, edge.left) > 0;
        if (number == NONE || !(sees_first || sees_second)) return false;
        const bool is_seen = sees_first && sees_second;
        const End third{{apex, place}, point_.vertex_count};
        point_.numbers[third.slot] = number;
        point_.straight[third.slot] = is_seen ? hypotenuse(place.x(), place.y()) : UNREACHABLE;
        ++point_.vertex_count;
        at = edges_[--count_];
        if (sees_first) add(face, edge.first, third, edge.right, is_seen ? place : edge.left);
        if (sees_second) add(face, third, edge.second, is_seen ? place : edge.right, edge.left);
        note(face, edge, third);
        return true;
    }

    void note(uint32_t face, const Edge& edge, const End& third) {
        SeenFaces::Face& noted = seen_.faces[seen_.count++];
        noted.face = face;
        noted.right = edge.right;
        noted.left = edge.left;
        const auto& corners = indexed_corners(surface_, face);
        for (const End& end : {edge.first, edge.second, third})
            noted.corners[static_cast<size_t>(std::ranges::find(corners, end.vertex) - corners.begin())] =
                end.at;
    }

    const Surface& surface_;
    const KnownFaces& known_;
    FacePoint& point_;
    SeenFaces& seen_;
    size_t count_ = 0;
    std::array<Edge, FacePoint::MOST_EDGES> edges_;
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

void see_farther(const Surface& surface, const SurfacePoint& at, const KnownFaces& known, FacePoint& point,
                 SeenFaces& seen) {
    Polygon polygon(surface, known, point, seen);
    if (!polygon.begin(at)) return;
    polygon.grow();
    polygon.finish();
}

}
