#include "src/path/tight_paths.h"

#include <algorithm>
#include <cmath>

#include "src/path/unfolded_face.h"

namespace geodesic {

namespace {

using Eigen::Vector2d;

// Of a share that is that of an end but for rounding, or beyond it, the share of that end: what begins there
// begins in all faces at the vertex.
double at_end_if_close(double share) {
    constexpr double ROUNDING = 1e-12;
    return share < ROUNDING ? 0 : share > 1 - ROUNDING ? 1 : share;
}

}

// The path between two bends.
struct TightPaths::Piece {
    Piece(const Funnel::Point& before, const Funnel::Point& after)
        : before(before), after(after), way(after.at - before.at), size(way.lpNorm<1>()) {}

    double crossing(const Vector2d& left, const Vector2d& right) const;

    const Funnel::Point &before, &after;
    const Vector2d way;
    const double size;
};

// Where the piece crosses a gate, as a share of the way from its right end to its left one. Where the piece
// leads along the gate, rounding decides where the lines cross: not before the one bend nor behind the other.
inline double TightPaths::Piece::crossing(const Vector2d& left, const Vector2d& right) const {
    constexpr double ALONG = 1e-6; // an angle
    const Vector2d across = left - right, to_begin = before.at - right;
    const double turn = cross(across, way), from = cross(to_begin, way);
    if (std::abs(turn) > ALONG * (size * across.lpNorm<1>())) return from / turn;
    const double square = across.squaredNorm();
    if (!(square > 0)) return 0;
    const double first = to_begin.dot(across) / square, last = (after.at - right).dot(across) / square;
    return turn == 0 ? first : std::clamp(from / turn, std::min(first, last), std::max(first, last));
}

// Between two portals that are vertices, or an end: faces `first` to `last`.
struct TightPaths::Part {
    size_t first, last;
    SurfacePoint from, to;
};

void TightPaths::pull_tight(const Strip& strip, StripPath& path) {
    path.shares.resize(strip.portals.size());
    Part part{0, 0, strip.source, strip.target};
    for (;; ++part.last) {
        const bool is_end = part.last == strip.portals.size();
        if (!is_end && !strip.portals[part.last].is_vertex()) continue;
        const uint32_t vertex = is_end ? NONE : strip.portals[part.last].a;
        part.to = is_end ? strip.target : corner_point(surface_, strip.faces[part.last], vertex);
        unfold(strip, part);
        find_bends();
        fill_shares(std::span(strip.portals).subspan(part.first, part.last - part.first),
                    path.shares.data() + part.first);
        if (is_end) break;
        path.shares[part.last] = 0;
        part.first = part.last + 1;
        part.from = corner_point(surface_, strip.faces[part.first], vertex);
    }
    path.length = length_of(surface_, strip, path.shares);
}

void TightPaths::unfold(const Strip& strip, const Part& part) {
    const auto count = static_cast<uint32_t>(part.last - part.first);
    if (gates_.size() < count) gates_.resize(count);
    UnfoldedFace face(surface_, strip.faces[part.first]);
    funnel_.begin(face.place(part.from.weights), 2 * size_t{count} + 1);
    Gate gate{0, 0};
    for (uint32_t i = 0; i < count; ++i) {
        const size_t f = part.first + i;
        const auto ends = face.go_through(strip.portals[f], strip.faces[f + 1]);
        const bool is_first = i == 0;
        if (is_first || ends != UnfoldedFace::NewEnds::RIGHT)
            gate.left = funnel_.add_left(face.left().at, face.left().vertex, i);
        if (is_first || ends != UnfoldedFace::NewEnds::LEFT)
            gate.right = funnel_.add_right(face.right().at, face.right().vertex, i);
        gates_[i] = gate;
    }
    funnel_.add_right(face.place(part.to.weights), NONE, count);
}

void TightPaths::find_bends() {
    const auto points = funnel_.points();
    bends_.clear();
    for (size_t i = points.size() - 1; i > 0; i = points[i].before)
        bends_.push_back(static_cast<uint32_t>(i));
    bends_.push_back(0);
    std::ranges::reverse(bends_);
}

// Where the path passes each of the portals, as a share of the way from its end a.
void TightPaths::fill_shares(std::span<const Portal> portals, double* shares) const {
    const auto points = funnel_.points();
    size_t i = 0;
    for (size_t bend = 1; bend < bends_.size(); ++bend) {
        const Piece piece(points[bends_[bend - 1]], points[bends_[bend]]);
        const size_t end = std::min<size_t>(piece.after.gate + 1, portals.size());
        for (; i < end; ++i) shares[i] = share(gates_[i], portals[i], piece);
    }
}

// The piece begins before the gate or at it, and ends there or behind it.
inline double TightPaths::share(const Gate& gate, const Portal& portal, const Piece& piece) const {
    for (const uint32_t bend : {piece.before.vertex, piece.after.vertex})
        if (portal.contains(bend)) return bend == portal.a ? 0 : 1;
    const Funnel::Point &left = funnel_.points()[gate.left], &right = funnel_.points()[gate.right];
    const double from_right = at_end_if_close(piece.crossing(left.at, right.at));
    return right.vertex == portal.a ? from_right : 1 - from_right;
}

}
