#include "src/path/window_trace.h"

#include <algorithm>
#include <vector>

#include "src/base/plane.h"
#include "src/metric/target_points.h"
#include "src/surface/nearby.h"

namespace geodesic {

namespace {

constexpr Portal NO_PORTAL{NONE, NONE};

// The last straight piece of a shortest path to a place in a face, `end`. The path comes into the face over
// an edge or at a vertex, `over`, unless it begins there, at the source; `before` is where, as a point of the
// face that it comes from.
struct Piece {
    double length = UNREACHABLE; // of the whole path to the end
    SurfacePoint end{};
    Portal over = NO_PORTAL;
    SurfacePoint before{};
};

class WindowTrace {
public:
    WindowTrace(const IntrinsicMesh& mesh, const WindowSolver& solver, const SurfacePoint& source)
        : mesh_(mesh), solver_(solver), sources_(in_all_faces(mesh, source)) {
        std::ranges::sort(sources_, {}, &SurfacePoint::face);
    }

    std::optional<Strip> run(const SurfacePoint& target) const;

private:
    Piece last_piece(const std::vector<SurfacePoint>& ends) const;
    void try_source(const SurfacePoint& end, Piece& best) const;
    void try_vertex(const SurfacePoint& end, uint32_t corner, Piece& best) const;
    void try_windows(const SurfacePoint& end, uint32_t corner, Piece& best) const;
    SurfacePoint crossed(const Window& window, uint32_t edge, double crossing) const;
    Portal vertex_portal(const SurfacePoint& point) const;

    const IntrinsicMesh& mesh_;
    const WindowSolver& solver_;
    std::vector<SurfacePoint> sources_; // the source as a point of each face that it is in, ascending
};

SurfacePoint point_at(uint32_t corner) {
    SurfacePoint point{corner / 3, {}};
    point.weights[corner % 3] = 1;
    return point;
}

void WindowTrace::try_source(const SurfacePoint& end, Piece& best) const {
    const SurfacePoint* const source = alias_in(sources_, end.face);
    if (!source) return;
    const PlanePoint from = place_on_side(mesh_, 3 * end.face, *source),
                     to = place_on_side(mesh_, 3 * end.face, end);
    const double length = hypotenuse(from.x - to.x, from.depth - to.depth);
    if (length < best.length) best = {length, end, NO_PORTAL, *source};
}

void WindowTrace::try_vertex(const SurfacePoint& end, uint32_t corner, Piece& best) const {
    const Side& side = mesh_.sides.items[mesh_.side_of_corner[corner]];
    const PlanePoint to = place_on_side(mesh_, corner, end);
    const double length =
        solver_.distance(side.apex) + hypotenuse(to.x - side.apex_x, to.depth - side.apex_depth);
    if (length < best.length) best = {length, end, {side.apex, side.apex}, point_at(corner)};
}

// Those on the edge opposite to a corner.
void WindowTrace::try_windows(const SurfacePoint& end, uint32_t corner, Piece& best) const {
    const uint32_t edge = mesh_.edge_of_corner[corner];
    const auto [first, second] = mesh_.edge_vertices[edge];
    const PlanePoint to = place_on_side(mesh_, corner, end);
    for (const Window& window : solver_.windows(edge)) {
        if (window.from_face == end.face) continue;
        const double crossing = window.crossing_to(to.x, to.depth);
        const double length = window.distance_at(crossing) + hypotenuse(crossing - to.x, to.depth);
        if (length < best.length) best = {length, end, {first, second}, crossed(window, edge, crossing)};
    }
}

// Where a path crosses an edge, as a point of the face that it comes from.
SurfacePoint WindowTrace::crossed(const Window& window, uint32_t edge, double crossing) const {
    const double share = std::clamp(crossing / mesh_.edge_length[edge], 0.0, 1.0);
    const auto [first, second] = mesh_.edge_vertices[edge];
    SurfacePoint point{window.from_face, {}};
    for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t vertex = corner_vertex(mesh_, 3 * window.from_face + k);
        if (vertex == first) point.weights[k] = 1 - share;
        if (vertex == second) point.weights[k] = share;
    }
    return point;
}

// At the vertex that a point is at, or none.
Portal WindowTrace::vertex_portal(const SurfacePoint& point) const {
    for (uint32_t k = 0; k < 3; ++k)
        if (const uint32_t vertex = corner_vertex(mesh_, 3 * point.face + k); point.weights[k] == 1)
            return {vertex, vertex};
    return NO_PORTAL;
}

// A path does not come over the edge or the vertex that its end lies on.
Piece WindowTrace::last_piece(const std::vector<SurfacePoint>& ends) const {
    Piece best;
    for (const SurfacePoint& end : ends) {
        try_source(end, best);
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t corner = 3 * end.face + k;
            if (end.weights[k] != 1) try_vertex(end, corner, best);
            if (end.weights[k] != 0) try_windows(end, corner, best);
        }
    }
    return best;
}

// Adds a piece to a strip that is built from the target on. The piece ends where the strip does, at a vertex
// perhaps in another face there: then the vertex becomes a portal.
void append(const Piece& piece, const Portal& at_vertex, Strip& strip) {
    if (strip.faces.empty()) {
        strip.source = piece.end;
        strip.faces.push_back(piece.end.face);
    } else if (piece.end.face != strip.faces.back()) {
        strip.portals.push_back(at_vertex);
        strip.faces.push_back(piece.end.face);
    }
    if (piece.before.face != piece.end.face) {
        strip.portals.push_back(piece.over);
        strip.faces.push_back(piece.before.face);
    }
    strip.target = piece.before;
}

// A shortest path crosses an edge and passes a vertex once at most.
std::optional<Strip> WindowTrace::run(const SurfacePoint& target) const {
    Strip strip;
    std::vector<SurfacePoint> ends = in_all_faces(mesh_, target);
    Portal at_vertex = NO_PORTAL; // of the ends, if they are at one
    const size_t most_pieces = mesh_.edge_length.size() + mesh_.spokes.size() + 1;
    for (size_t i = 0; i < most_pieces; ++i) {
        const Piece piece = last_piece(ends);
        if (piece.length == UNREACHABLE) break;
        append(piece, at_vertex, strip);
        if (piece.over == NO_PORTAL) return strip;
        at_vertex = vertex_portal(piece.before);
        ends = at_vertex == NO_PORTAL ? std::vector{piece.before} : in_all_faces(mesh_, piece.before);
    }
    return std::nullopt;
}

}

std::optional<Strip> trace_back(const IntrinsicMesh& mesh, const WindowSolver& solver,
                                const SurfacePoint& target, const SurfacePoint& source) {
    return WindowTrace(mesh, solver, source).run(target);
}

}
