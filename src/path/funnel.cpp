#include "src/path/funnel.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <Eigen/Geometry>

namespace geodesic {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// The third vertex of a triangle with a gate as a side: ahead of whoever goes through the gate. Vertices that
// are one but for rounding are placed at one point, since no direction from one to the other is left there.
Vector2d place_ahead(const Surface& surface, const Gate& gate, uint32_t ahead) {
    constexpr double SAME = 1e-12; // of the gate's length
    const Vector3d &left = surface.positions[gate.left_vertex], &right = surface.positions[gate.right_vertex];
    const Vector3d along = left - right, to = surface.positions[ahead] - right;
    const double square = along.squaredNorm(), length = std::sqrt(square);
    const Vector2d across = gate.left - gate.right;
    const double placed_length = across.norm();
    if (!(placed_length > 0)) return gate.right + Vector2d(to.norm(), 0);
    if (to.squaredNorm() < square * (SAME * SAME)) return gate.right;
    if ((to - along).squaredNorm() < square * (SAME * SAME)) return gate.left;
    const double foot = to.dot(along) / length, height = along.cross(to).norm() / length;
    const Vector2d direction = across / placed_length;
    return gate.right + foot * direction + height * Vector2d(direction.y(), -direction.x());
}

// Of a share that is that of an end but for rounding, or beyond it, the share of that end: what begins there
// begins in all faces at the vertex.
double at_end_if_close(double share) {
    constexpr double ROUNDING = 1e-12;
    return share < ROUNDING ? 0 : share > 1 - ROUNDING ? 1 : share;
}

// Where the straight way between two points crosses a gate, as a share of the way from its right end to its
// left one. Where the way leads along the gate, rounding decides where the lines cross: not before the one
// point nor behind the other.
double crossing(const Gate& gate, const Vector2d& begin, const Vector2d& end) {
    constexpr double ALONG = 1e-6; // an angle
    const Vector2d way = end - begin, across = gate.left - gate.right;
    const double turn = cross(across, way), square = across.squaredNorm();
    const double from = cross(begin - gate.right, way);
    if (std::abs(turn) > ALONG * (way.lpNorm<1>() * across.lpNorm<1>())) return from / turn;
    if (!(square > 0)) return 0;
    const double first = (begin - gate.right).dot(across) / square,
                 last = (end - gate.right).dot(across) / square;
    return turn == 0 ? first : std::clamp(from / turn, std::min(first, last), std::max(first, last));
}

// The face of a strip that was unfolded last: its vertices, and where they are in the plane. The first one
// lies counterclockwise.
class UnfoldedFace {
public:
    UnfoldedFace(const Surface& surface, uint32_t face)
        : surface_(surface), face_(face), vertices_(surface.faces[face]) {
        const auto& v = vertices_;
        const double length = (surface.positions[v[0]] - surface.positions[v[1]]).norm();
        corners_[0] = Vector2d(0, 0);
        corners_[1] = Vector2d(length, 0);
        corners_[2] = place_ahead(surface, {v[0], v[1], corners_[0], corners_[1]}, v[2]);
    }

    // Goes on through a gate, which is added, into the next face, whose third vertex is placed ahead of it.
    void go_through(const Portal& portal, uint32_t next_face, std::vector<Gate>& gates) {
        const size_t apex = !portal.contains(vertices_[0]) ? 0 : !portal.contains(vertices_[1]) ? 1 : 2;
        const size_t right = (apex + 1) % 3, left = (apex + 2) % 3;
        gates.push_back({vertices_[left], vertices_[right], corners_[left], corners_[right]});
        const Gate& gate = gates.back();
        const auto& next = surface_.faces[next_face];
        const uint32_t ahead = next[0] + next[1] + next[2] - portal.a - portal.b; // the one that is no end
        corners_ = {gate.left, gate.right, place_ahead(surface_, gate, ahead)};
        vertices_ = {gate.left_vertex, gate.right_vertex, ahead};
        face_ = next_face;
    }

    // A point of that face, by its weights.
    Vector2d place(const std::array<double, 3>& weights) const {
        Vector2d at(0, 0);
        for (size_t k = 0; k < 3; ++k) at += weights[corner_of(surface_, face_, vertices_[k])] * corners_[k];
        return at;
    }

private:
    const Surface& surface_;
    uint32_t face_;
    std::array<uint32_t, 3> vertices_;
    std::array<Vector2d, 3> corners_;
};

// Between two bends, of which the path passes one before or at the gate, and the other at the gate or behind.
double share(const Gate& gate, const Portal& portal, const Funnel::Point& before,
             const Funnel::Point& after) {
    for (const Funnel::Point* bend : {&before, &after})
        if (bend->vertex != NONE && portal.contains(bend->vertex)) return bend->vertex == portal.a ? 0 : 1;
    const double from_right = at_end_if_close(crossing(gate, before.at, after.at));
    return gate.right_vertex == portal.a ? from_right : 1 - from_right;
}

}

void Funnel::begin(const Vector2d& source, size_t count) {
    farthest_ = source.lpNorm<1>();
    points_.assign(1, {source, NONE, 0, 0});
    if (chain_.size() < 2 * count + 1) chain_.resize(2 * count + 1);
    left_ = apex_ = right_ = count;
    chain_[apex_] = 0;
}

// What the way there passes no more leaves the chain of its side; where that is all of it, the apex may move
// along the other chain.
void Funnel::add_left(const Vector2d& at, uint32_t vertex, size_t gate) {
    while (left_ < apex_ && turn(chain_[left_ + 1], chain_[left_], at) <= 0) ++left_;
    while (left_ == apex_ && apex_ < right_ && turn(chain_[apex_], chain_[apex_ + 1], at) < 0)
        left_ = ++apex_;
    const size_t before = chain_[left_];
    chain_[--left_] = add({at, vertex, gate, before});
}

void Funnel::add_right(const Vector2d& at, uint32_t vertex, size_t gate) {
    while (right_ > apex_ && turn(chain_[right_ - 1], chain_[right_], at) >= 0) --right_;
    while (right_ == apex_ && apex_ > left_ && turn(chain_[apex_], chain_[apex_ - 1], at) > 0)
        right_ = --apex_;
    const size_t before = chain_[right_];
    chain_[++right_] = add({at, vertex, gate, before});
}

// Over 0 if the way from `first` over `second` to a position turns left, and 0 where it is straight but for
// the rounding of positions, as within a needle.
double Funnel::turn(size_t first, size_t second, const Vector2d& at) const {
    constexpr double ROUNDING = 1e-14; // as a share of positions
    const Vector2d &begin = points_[first].at, way = points_[second].at - begin, on = at - begin;
    const double turn = cross(way, on);
    return std::abs(turn) <= ROUNDING * farthest_ * (way.lpNorm<1>() + on.lpNorm<1>()) ? 0 : turn;
}

size_t Funnel::add(const Point& point) {
    farthest_ = std::max(farthest_, point.at.lpNorm<1>());
    points_.push_back(point);
    return points_.size() - 1;
}

// Between two portals that are vertices, or an end: faces `first` to `last`.
struct TightPaths::Part {
    size_t first, last;
    SurfacePoint from, to;
};

void TightPaths::pull_tight(const Strip& strip, StripPath& path) {
    path.shares.clear();
    path.shares.reserve(strip.portals.size());
    Part part{0, 0, strip.source, strip.target};
    for (;; ++part.last) {
        const bool is_end = part.last == strip.portals.size();
        if (!is_end && !strip.portals[part.last].is_vertex()) continue;
        const uint32_t vertex = is_end ? NONE : strip.portals[part.last].a;
        part.to = is_end ? strip.target : corner_point(surface_, strip.faces[part.last], vertex);
        unfold(strip, part);
        find_bends();
        add_shares(std::span(strip.portals).subspan(part.first, part.last - part.first), path.shares);
        if (is_end) break;
        path.shares.push_back(0);
        part.first = part.last + 1;
        part.from = corner_point(surface_, strip.faces[part.first], vertex);
    }
    path.length = length_of(surface_, strip, path.shares);
}

void TightPaths::unfold(const Strip& strip, const Part& part) {
    UnfoldedFace face(surface_, strip.faces[part.first]);
    gates_.clear();
    funnel_.begin(face.place(part.from.weights), part.last - part.first + 2);
    for (size_t f = part.first; f < part.last; ++f) {
        face.go_through(strip.portals[f], strip.faces[f + 1], gates_);
        widen_funnel();
    }
    funnel_.add_right(face.place(part.to.weights), NONE, gates_.size());
}

// By the last gate, of which one end is one of the gate before.
void TightPaths::widen_funnel() {
    const size_t i = gates_.size() - 1;
    const Gate& gate = gates_[i];
    if (i == 0 || gates_[i - 1].left_vertex != gate.left_vertex)
        funnel_.add_left(gate.left, gate.left_vertex, i);
    if (i == 0 || gates_[i - 1].right_vertex != gate.right_vertex)
        funnel_.add_right(gate.right, gate.right_vertex, i);
}

void TightPaths::find_bends() {
    const auto& points = funnel_.points();
    bends_.clear();
    for (size_t i = points.size() - 1; i > 0; i = points[i].before) bends_.push_back(i);
    bends_.push_back(0);
    std::ranges::reverse(bends_);
}

// Where the path passes each of the portals, as a share of the way from its end a.
void TightPaths::add_shares(std::span<const Portal> portals, std::vector<double>& shares) const {
    const auto& points = funnel_.points();
    size_t behind = 1;
    for (size_t i = 0; i < portals.size(); ++i) {
        while (points[bends_[behind]].gate < i) ++behind;
        shares.push_back(share(gates_[i], portals[i], points[bends_[behind - 1]], points[bends_[behind]]));
    }
}

}
