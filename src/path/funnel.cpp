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

// A portal in the plane, its ends named as whoever goes through it sees them.
struct Gate {
    uint32_t left_vertex, right_vertex;
    Vector2d left, right;
};

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

// A part of a strip between two portals that are vertices, or an end: faces `first` to `last`, unfolded.
class Unfolded {
public:
    Unfolded(const Surface& surface, const Strip& strip, size_t first, size_t last, const SurfacePoint& from,
             const SurfacePoint& to)
        : surface_(surface) {
        unfold(strip, first, last, from, to);
        pull_tight();
    }

    // Adds where the path passes each of the portals, as a share of the way from its end a.
    void add_shares(std::span<const Portal> portals, std::vector<double>& shares) const;

private:
    // The path passes a vertex of the gate of this index, or it is an end, before or behind all gates.
    struct Bend {
        std::ptrdiff_t gate;
        uint32_t vertex;
        Vector2d at;
    };

    double distance(uint32_t a, uint32_t b) const {
        return (surface_.positions[a] - surface_.positions[b]).norm();
    }
    void unfold(const Strip& strip, size_t first, size_t last, const SurfacePoint& from,
                const SurfacePoint& to);
    void pull_tight();
    double share(const Gate& gate, const Portal& portal, const Bend& before, const Bend& after) const;

    const Surface& surface_;
    std::vector<Gate> gates_;
    Vector2d from_, to_;
    std::vector<Bend> bends_;
};

Vector2d weighted(const std::array<Vector2d, 3>& corners, const std::array<double, 3>& weights) {
    return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
}

// The first face lies counterclockwise. From each gate the third vertex of the face behind it is placed, and
// the next gate joins it to one of the two ends.
void Unfolded::unfold(const Strip& strip, size_t first, size_t last, const SurfacePoint& from,
                      const SurfacePoint& to) {
    const auto& v = surface_.faces[strip.faces[first]];
    std::array<Vector2d, 3> corners{Vector2d(0, 0), Vector2d(distance(v[0], v[1]), 0), {}};
    corners[2] = place_ahead(surface_, {v[0], v[1], corners[0], corners[1]}, v[2]);
    from_ = weighted(corners, from.weights);
    std::array<uint32_t, 3> vertices = v;
    gates_.reserve(last - first);
    for (size_t f = first; f < last; ++f) {
        const Portal& portal = strip.portals[f];
        size_t apex = 0;
        while (portal.contains(vertices[apex])) ++apex;
        const size_t right = (apex + 1) % 3, left = (apex + 2) % 3;
        gates_.push_back({vertices[left], vertices[right], corners[left], corners[right]});
        const Gate& gate = gates_.back();
        const auto& next = surface_.faces[strip.faces[f + 1]];
        const uint32_t ahead = *std::ranges::find_if(next, [&](uint32_t u) { return !portal.contains(u); });
        corners = {gate.left, gate.right, place_ahead(surface_, gate, ahead)};
        vertices = {gate.left_vertex, gate.right_vertex, ahead};
    }
    std::array<double, 3> weights;
    for (size_t k = 0; k < 3; ++k)
        weights[k] = to.weights[corner_of(surface_, strip.faces[last], vertices[k])];
    to_ = weighted(corners, weights);
}

// The shortest ways from the source to both ends of a gate: together up to the apex, from there along a chain
// to each end. `points_` has the chain to the left end, from the end back to the apex, and then that to the
// right end.
class Funnel {
public:
    // So many points may be added. They are given by their positions among those that were added; -1 is the
    // source.
    Funnel(const Vector2d& source, size_t count) : source_(source), farthest_(source.lpNorm<1>()) {
        at_.reserve(count);
        before_.reserve(count);
        points_.resize(2 * count + 1);
        left_ = apex_ = right_ = count;
        points_[apex_] = -1;
    }

    // The next point that a side comes to. What the way there passes no more leaves the chain of its side;
    // where that is all of it, the apex may move along the other chain.
    void add_left(const Vector2d& at) {
        while (left_ < apex_ && turns(points_[left_ + 1], points_[left_], at) <= 0) ++left_;
        while (left_ == apex_ && apex_ < right_ && turns(points_[apex_], points_[apex_ + 1], at) < 0)
            left_ = ++apex_;
        points_[left_ - 1] = add(at, points_[left_]);
        --left_;
    }
    void add_right(const Vector2d& at) {
        while (right_ > apex_ && turns(points_[right_ - 1], points_[right_], at) >= 0) --right_;
        while (right_ == apex_ && apex_ > left_ && turns(points_[apex_], points_[apex_ - 1], at) > 0)
            right_ = --apex_;
        points_[right_ + 1] = add(at, points_[right_]);
        ++right_;
    }

    // The point before another one on the shortest way.
    std::ptrdiff_t before(std::ptrdiff_t point) const { return before_[static_cast<size_t>(point)]; }

private:
    const Vector2d& position(std::ptrdiff_t point) const {
        return point < 0 ? source_ : at_[static_cast<size_t>(point)];
    }
    // Over 0 if the way from `first` over `second` to a position turns left, and 0 where it is straight but
    // for the rounding of positions, as within a needle.
    double turns(std::ptrdiff_t first, std::ptrdiff_t second, const Vector2d& at) const {
        constexpr double ROUNDING = 1e-14; // as a share of positions
        const Vector2d way = position(second) - position(first), on = at - position(first);
        const double turn = cross(way, on);
        return std::abs(turn) <= ROUNDING * farthest_ * (way.lpNorm<1>() + on.lpNorm<1>()) ? 0 : turn;
    }
    std::ptrdiff_t add(const Vector2d& at, std::ptrdiff_t before) {
        farthest_ = std::max(farthest_, at.lpNorm<1>());
        at_.push_back(at);
        before_.push_back(before);
        return static_cast<std::ptrdiff_t>(at_.size()) - 1;
    }

    const Vector2d source_;
    double farthest_; // of all positions, from the origin
    std::vector<Vector2d> at_;
    std::vector<std::ptrdiff_t> before_;
    std::vector<std::ptrdiff_t> points_;
    size_t left_, apex_, right_; // in points_
};

// From each gate to the next one, one of its ends stays. `points` are those that the funnel numbers.
void Unfolded::pull_tight() {
    const auto count = static_cast<std::ptrdiff_t>(gates_.size());
    Funnel funnel(from_, gates_.size() + 2);
    std::vector<Bend> points;
    points.reserve(gates_.size() + 2);
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        const Gate& gate = gates_[static_cast<size_t>(i)];
        const Gate* const before = i > 0 ? &gate - 1 : nullptr;
        if (!before || before->left_vertex != gate.left_vertex) {
            funnel.add_left(gate.left);
            points.push_back({i, gate.left_vertex, gate.left});
        }
        if (!before || before->right_vertex != gate.right_vertex) {
            funnel.add_right(gate.right);
            points.push_back({i, gate.right_vertex, gate.right});
        }
    }
    funnel.add_right(to_);
    points.push_back({count, NONE, to_});
    for (auto i = static_cast<std::ptrdiff_t>(points.size()) - 1; i >= 0; i = funnel.before(i))
        bends_.push_back(points[static_cast<size_t>(i)]);
    bends_.push_back({-1, NONE, from_});
    std::ranges::reverse(bends_);
}

void Unfolded::add_shares(std::span<const Portal> portals, std::vector<double>& shares) const {
    size_t behind = 0;
    for (size_t i = 0; i < portals.size(); ++i) {
        while (bends_[behind].gate < static_cast<std::ptrdiff_t>(i)) ++behind;
        shares.push_back(share(gates_[i], portals[i], bends_[behind - 1], bends_[behind]));
    }
}

// Between two bends, of which the path passes one before or at the gate, and the other at the gate or behind.
double Unfolded::share(const Gate& gate, const Portal& portal, const Bend& before, const Bend& after) const {
    for (const Bend* bend : {&before, &after})
        if (bend->vertex != NONE && portal.contains(bend->vertex)) return bend->vertex == portal.a ? 0 : 1;
    const double from_right = at_end_if_close(crossing(gate, before.at, after.at));
    return gate.right_vertex == portal.a ? from_right : 1 - from_right;
}

SurfacePoint at_vertex(const Surface& surface, uint32_t face, uint32_t vertex) {
    SurfacePoint point{face, {}};
    point.weights[corner_of(surface, face, vertex)] = 1;
    return point;
}

}

StripPath shortest_in_strip(const Surface& surface, const Strip& strip) {
    StripPath path;
    path.shares.reserve(strip.portals.size());
    size_t first = 0;
    SurfacePoint from = strip.source;
    for (size_t i = 0; i <= strip.portals.size(); ++i) {
        const bool is_end = i == strip.portals.size();
        if (!is_end && !strip.portals[i].is_vertex()) continue;
        const SurfacePoint to =
            is_end ? strip.target : at_vertex(surface, strip.faces[i], strip.portals[i].a);
        const Unfolded part(surface, strip, first, i, from, to);
        part.add_shares(std::span(strip.portals).subspan(first, i - first), path.shares);
        if (is_end) break;
        path.shares.push_back(0);
        first = i + 1;
        from = at_vertex(surface, strip.faces[first], strip.portals[i].a);
    }
    path.length = length_of(surface, strip, path.shares);
    return path;
}

}
