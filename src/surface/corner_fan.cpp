#include "src/surface/corner_fan.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "src/surface/unfolded_vertex.h"

namespace geodesic {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The only other face at the edge between two vertices of a face, or NONE. There are fewer faces to look at
// around one end than around the hub of a wheel.
uint32_t only_face_beyond(const Surface& surface, uint32_t face, uint32_t v, uint32_t w) {
    if (surface.vertex_faces.room_for(w) < surface.vertex_faces.room_for(v)) std::swap(v, w);
    uint32_t found = NONE, count = 0;
    for_each_face_beyond(surface, face, v, w, [&](uint32_t other) {
        found = other;
        ++count;
    });
    return count == 1 ? found : NONE;
}

// Whether the corners of a face lie on one line, but for rounding: its angles do not tell where it ends.
bool is_too_flat(const Surface& surface, uint32_t face) {
    constexpr double ROUNDING = 1e-12;
    const auto& [a, b, c] = surface.faces[face];
    const Vector3d ab = surface.positions[b] - surface.positions[a],
                   ac = surface.positions[c] - surface.positions[a];
    return !(ab.cross(ac).norm() > ROUNDING * std::max(ab.squaredNorm(), ac.squaredNorm()));
}

// Unfolds the faces around a vertex, which becomes the origin, from one point on, which becomes a point of
// the first axis.
class CornerFan {
public:
    CornerFan(const Surface& surface, const SurfacePoint& from, uint32_t vertex)
        : surface_(surface), vertex_(vertex), face_(from.face),
          last_(position_of(surface, from) - surface.positions[vertex]), placed_(last_.norm(), 0),
          from_(placed_) {}

    // The straight line to a point of another face, where the fan begins with the edge to `end`.
    double straight_to(const SurfacePoint& to, uint32_t end) {
        const uint32_t first_face = face_;
        while (turn_to(surface_.positions[end])) {
            narrow();
            face_ = only_face_beyond(surface_, face_, vertex_, end);
            if (face_ == NONE || face_ == first_face || is_too_flat(surface_, face_)) return UNREACHABLE;
            if (face_ == to.face) return straight_in_face(to);
            end = third_vertex(end);
        }
        return UNREACHABLE;
    }

private:
    // Places a position beside the last one. Returns whether that is less than half a turn from the first.
    bool turn_to(const Vector3d& position) {
        const Vector3d next = position - surface_.positions[vertex_];
        const double along = last_.dot(next), across = last_.cross(next).norm();
        placed_ =
            Vector2d(placed_.x() * along - placed_.y() * across, placed_.x() * across + placed_.y() * along) /
            last_.squaredNorm();
        last_ = next;
        return placed_.y() > 0 || (placed_.y() == 0 && placed_.x() > 0);
    }

    // The line must pass the end of the edge that was placed last on the side of the vertex.
    void narrow() {
        const Vector2d seen = placed_ - from_;
        if (cross(bound_, seen) >= 0) bound_ = seen;
    }

    double straight_in_face(const SurfacePoint& to) {
        if (!turn_to(position_of(surface_, to))) return UNREACHABLE;
        const Vector2d straight = placed_ - from_;
        return cross(bound_, straight) >= 0 ? straight.norm() : UNREACHABLE;
    }

    uint32_t third_vertex(uint32_t end) const {
        const auto& [a, b, c] = surface_.faces[face_];
        return a + b + c - vertex_ - end;
    }

    const Surface& surface_;
    const uint32_t vertex_;
    uint32_t face_;
    Vector3d last_;   // what was placed last, as seen from the vertex
    Vector2d placed_; // the same in the plane
    const Vector2d from_;
    Vector2d bound_{0, 0}; // how far to the outside the line may lead
};

}

double straight_around(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b,
                       uint32_t vertex) {
    const SurfacePoint& from = a.face < b.face ? a : b;
    const SurfacePoint& to = a.face < b.face ? b : a;
    double least = UNREACHABLE;
    if (is_too_flat(surface, from.face)) return least;
    for (const uint32_t end : surface.faces[from.face])
        if (end != vertex) least = std::min(least, CornerFan(surface, from, vertex).straight_to(to, end));
    return least;
}

}
