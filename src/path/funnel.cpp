#include "src/path/funnel.h"

#include <algorithm>
#include <cmath>

#include "src/base/plane.h"

namespace geodesic {

namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// The third vertex of a triangle that lies to the right of the way from `right` to `left`: ahead of whoever
// goes between the two.
Vector2d place_ahead(const Vector2d& left, const Vector2d& right, double to_left, double to_right) {
    const Vector2d across = left - right;
    const double length = across.norm();
    if (!(length > 0)) return right + Vector2d(to_right, 0);
    const double foot = foot_of(length, to_right, to_left);
    const double height = std::sqrt(std::max(0.0, (to_right - foot) * (to_right + foot)));
    const Vector2d along = across / length, ahead(along.y(), -along.x());
    return right + foot * along + height * ahead;
}

// A portal in the plane, its ends named as whoever goes through it sees them.
struct Gate {
    uint32_t left_vertex, right_vertex;
    Vector2d left, right;
};

// A part of a strip between two portals that are vertices, or an end: faces `first` to `last`, unfolded.
class Unfolded {
public:
    Unfolded(const Surface& surface, const Strip& strip, size_t first, size_t last, const SurfacePoint& from,
             const SurfacePoint& to)
        : surface_(surface) {
        unfold(strip, first, last, from, to);
        pull_tight();
    }

    // Where the path passes the i-th portal of the part, as a share of the way from its end a.
    double share(size_t i, const Portal& portal) const;

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
    corners[2] = place_ahead(corners[0], corners[1], distance(v[0], v[2]), distance(v[1], v[2]));
    from_ = weighted(corners, from.weights);
    std::array<uint32_t, 3> vertices = v;
    for (size_t f = first; f < last; ++f) {
        const Portal& portal = strip.portals[f];
        size_t apex = 0;
        while (portal.contains(vertices[apex])) ++apex;
        const size_t right = (apex + 1) % 3, left = (apex + 2) % 3;
        gates_.push_back({vertices[left], vertices[right], corners[left], corners[right]});
        const Gate& gate = gates_.back();
        const auto& next = surface_.faces[strip.faces[f + 1]];
        const uint32_t ahead = *std::ranges::find_if(next, [&](uint32_t u) { return !portal.contains(u); });
        corners = {gate.left, gate.right,
                   place_ahead(gate.left, gate.right, distance(gate.left_vertex, ahead),
                               distance(gate.right_vertex, ahead))};
        vertices = {gate.left_vertex, gate.right_vertex, ahead};
    }
    std::array<double, 3> weights;
    for (size_t k = 0; k < 3; ++k)
        weights[k] = to.weights[corner_of(surface_, strip.faces[last], vertices[k])];
    to_ = weighted(corners, weights);
}

// Both sides of the funnel from the latest bend get narrower gate by gate; where one would pass the other,
// the path bends there.
void Unfolded::pull_tight() {
    const auto count = static_cast<std::ptrdiff_t>(gates_.size());
    bends_.push_back({-1, NONE, from_});
    for (;;) {
        const Bend apex = bends_.back();
        Bend left{apex.gate, apex.vertex, apex.at}, right = left;
        const Bend* next = nullptr;
        bool left_open = false, right_open = false; // whether a side has left the apex
        for (std::ptrdiff_t i = apex.gate + 1; i <= count && !next; ++i) {
            const Gate end{NONE, NONE, to_, to_};
            const Gate& gate = i < count ? gates_[static_cast<size_t>(i)] : end;
            const Vector2d to_right = gate.right - apex.at, to_left = gate.left - apex.at;
            if (!right_open || cross(right.at - apex.at, to_right) >= 0) {
                if (left_open && cross(left.at - apex.at, to_right) > 0) {
                    next = &left;
                    break;
                }
                right = {i, gate.right_vertex, gate.right};
                right_open = i == count || gate.right_vertex != apex.vertex || apex.vertex == NONE;
            }
            if (!left_open || cross(left.at - apex.at, to_left) <= 0) {
                if (right_open && cross(right.at - apex.at, to_left) < 0) {
                    next = &right;
                    break;
                }
                left = {i, gate.left_vertex, gate.left};
                left_open = i == count || gate.left_vertex != apex.vertex || apex.vertex == NONE;
            }
        }
        if (!next || next->gate >= count) break;
        bends_.push_back(Bend(*next));
    }
    bends_.push_back({count, NONE, to_});
}

double Unfolded::share(size_t i, const Portal& portal) const {
    const auto gate_index = static_cast<std::ptrdiff_t>(i);
    const auto behind = std::ranges::find_if(bends_, [&](const Bend& b) { return b.gate >= gate_index; });
    const Bend &before = *(behind - 1), &after = *behind;
    for (const Bend* bend : {&before, &after})
        if (bend->vertex != NONE && portal.contains(bend->vertex)) return bend->vertex == portal.a ? 0 : 1;
    const Gate& gate = gates_[i];
    const Vector2d along = after.at - before.at, across = gate.left - gate.right;
    const double denominator = cross(along, across);
    if (denominator == 0) { // all in one line: at the end that is nearer to the way
        const bool at_right = (gate.right - before.at).squaredNorm() <= (gate.left - before.at).squaredNorm();
        return (at_right ? gate.right_vertex : gate.left_vertex) == portal.a ? 0 : 1;
    }
    const double from_right = std::clamp(cross(before.at - gate.right, along) / -denominator, 0.0, 1.0);
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
    size_t first = 0;
    SurfacePoint from = strip.source;
    for (size_t i = 0; i <= strip.portals.size(); ++i) {
        const bool is_end = i == strip.portals.size();
        if (!is_end && !strip.portals[i].is_vertex()) continue;
        const SurfacePoint to =
            is_end ? strip.target : at_vertex(surface, strip.faces[i], strip.portals[i].a);
        const Unfolded part(surface, strip, first, i, from, to);
        for (size_t k = first; k < i; ++k) path.shares.push_back(part.share(k - first, strip.portals[k]));
        if (is_end) break;
        path.shares.push_back(0);
        first = i + 1;
        from = at_vertex(surface, strip.faces[first], strip.portals[i].a);
    }
    path.length = length_of(surface, strip, path.shares);
    return path;
}

}
