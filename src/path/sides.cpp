#include "src/path/sides.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>

#include "src/base/number_map.h"
#include "src/base/plane.h"
#include "src/mesh/angle.h"
#include "src/path/straighten.h"
#include "src/surface/nearby.h"

namespace geodesic {

namespace {

using Eigen::Vector3d;

class OtherSides {
public:
    explicit OtherSides(const Surface& surface) : surface_(surface), straightening_(surface) {}

    void run(StripWay& way);

private:
    struct Point {
        Vector3d at;
        uint32_t vertex = NONE;                 // that the path passes there
        double along = 0;                       // length of the path up to there
        size_t bend_before = 0, bend_after = 0; // the next points at vertices, or the ends
    };
    void measure();
    Pass pass_of(size_t portal, uint32_t vertex) const;
    bool is_begin(size_t portal, uint32_t vertex) const {
        return !way_.strip.portals[portal].is_vertex() &&
               (portal == 0 || !way_.strip.portals[portal - 1].contains(vertex));
    }
    double angle_around(uint32_t vertex);
    double length(PointRange range) const { return points_[range.last].along - points_[range.first].along; }
    double angle_at(const Place& beside, PointRange range) const;
    double least_below_pi(const Place& beside, PointRange range) const;
    std::optional<Place> beside(const Pass& pass) const;
    PointRange piece_around(const Pass& pass) const;
    PointRange with_next_pieces(PointRange range) const;
    std::optional<Place> place_to_pass(const Pass& pass);
    std::optional<Turn::Fan> other_side(const Pass& pass, const Place& place) const;
    bool take(const Pass& pass, const Turn::Fan& fan, PointRange range);
    std::optional<size_t> try_at(const Pass& pass);
    bool sweep();

    const Surface& surface_;
    StripWay way_;
    Straightening straightening_;
    StripWay other_; // a part of the way on the other side of a vertex
    std::vector<Point> points_;
    NumberMap<double> angles_; // all around vertices
    // What did not help, of any way: the vertex and the face before it, and the length of the part.
    std::set<std::tuple<uint32_t, uint32_t, double>> failed_;
    size_t tries_ = 0;
};

void OtherSides::measure() {
    points_.clear();
    points_.push_back({position_of(surface_, way_.strip.source)});
    for (size_t i = 0; i < way_.strip.portals.size(); ++i)
        points_.push_back({position_at(surface_, way_.strip.portals[i], way_.path.shares[i]),
                           vertex_at(way_.strip.portals[i], way_.path.shares[i])});
    points_.push_back({position_of(surface_, way_.strip.target)});
    for (size_t i = 1; i < points_.size(); ++i)
        points_[i].along = points_[i - 1].along + (points_[i].at - points_[i - 1].at).norm();
    const size_t end = points_.size() - 1;
    for (size_t i = 1; i <= end; ++i)
        points_[i].bend_before = points_[i - 1].vertex != NONE ? i - 1 : points_[i - 1].bend_before;
    points_[end].bend_after = end;
    for (size_t i = end; i-- > 0;)
        points_[i].bend_after = points_[i + 1].vertex != NONE ? i + 1 : points_[i + 1].bend_after;
}

Pass OtherSides::pass_of(size_t portal, uint32_t vertex) const {
    size_t last = portal;
    while (last + 1 < way_.strip.portals.size() && way_.strip.portals[last + 1].contains(vertex)) ++last;
    return {portal, last, vertex};
}

double OtherSides::angle_around(uint32_t vertex) {
    double& angle = angles_[vertex];
    if (angle > 0) return angle;
    const Vector3d at = surface_.positions[vertex];
    AngleSum sum;
    for (const uint32_t face : surface_.vertex_faces[vertex]) {
        const uint32_t k = corner_of(surface_, face, vertex);
        const Vector3d a = surface_.positions[surface_.faces[face][(k + 1) % 3]] - at,
                       b = surface_.positions[surface_.faces[face][(k + 2) % 3]] - at;
        sum.add(a, b);
    }
    return angle = sum.value();
}

// The angle at which the straight path between two points is seen.
double OtherSides::angle_at(const Place& beside, PointRange range) const {
    return std::atan2(beside.foot - points_[range.first].along, beside.height) +
           std::atan2(points_[range.last].along - beside.foot, beside.height);
}

// At least by how much that angle is below pi: an angle is no less than its sine.
double OtherSides::least_below_pi(const Place& beside, PointRange range) const {
    return beside.height / hypotenuse(beside.foot - points_[range.first].along, beside.height) +
           beside.height / hypotenuse(points_[range.last].along - beside.foot, beside.height);
}

// Where along the path a vertex beside it is, measured from the longest piece within the faces at the vertex;
// nothing where the path bends there.
std::optional<Place> OtherSides::beside(const Pass& pass) const {
    size_t longest = pass.first;
    for (size_t i = pass.first; i <= pass.last + 1; ++i) {
        if (i > pass.first && points_[i].vertex != NONE) return std::nullopt;
        if (length({i, i + 1}) > length({longest, longest + 1})) longest = i;
    }
    const double piece = length({longest, longest + 1});
    if (!(piece > 0)) return std::nullopt;
    const Vector3d direction = (points_[longest + 1].at - points_[longest].at) / piece;
    const Place place = place_beside(points_[longest].at, direction, surface_.positions[pass.vertex]);
    return Place{points_[longest].along + place.foot, place.height};
}

// Between the bends before and after it.
PointRange OtherSides::piece_around(const Pass& pass) const {
    return {points_[pass.first + 1].bend_before, points_[pass.last + 1].bend_after};
}

PointRange OtherSides::with_next_pieces(PointRange range) const {
    auto& [first, last] = range;
    for (const uint32_t v = points_[first].vertex; first > 0 && points_[first].vertex == v;) --first;
    if (points_[first].vertex == NONE) first = points_[first].bend_before;
    const size_t end = points_.size() - 1;
    for (const uint32_t v = points_[last].vertex; last < end && points_[last].vertex == v;) ++last;
    if (points_[last].vertex == NONE) last = points_[last].bend_after;
    return range;
}

// Where the vertex is, if it sees the bends before and after it at an angle of less than pi over its other
// side. Otherwise the path would bend at the vertex, and turn back to where it came from.
std::optional<Place> OtherSides::place_to_pass(const Pass& pass) {
    const double around = angle_around(pass.vertex);
    if (!(around < 2 * std::numbers::pi)) return std::nullopt;
    const auto place = beside(pass);
    if (!place) return std::nullopt;
    const PointRange piece = piece_around(pass);
    if (around + least_below_pi(*place, piece) > 2 * std::numbers::pi) return std::nullopt;
    if (!(around < std::numbers::pi + angle_at(*place, piece))) return std::nullopt;
    return place;
}

std::optional<Turn::Fan> OtherSides::other_side(const Pass& pass, const Place& place) const {
    const Vector3d at = surface_.positions[pass.vertex], from = points_[pass.first].at - at,
                   to = points_[pass.last + 2].at - at;
    const uint32_t first = way_.strip.faces[pass.first], last = way_.strip.faces[pass.last + 1];
    if (first == last || from.isZero(0) || to.isZero(0)) return std::nullopt;
    Turn turn(surface_, pass.vertex);
    for (size_t i = pass.first; i <= pass.last; ++i) {
        const Portal& portal = way_.strip.portals[i];
        turn.forbid(portal.a == pass.vertex ? portal.b : portal.a);
    }
    const double here = angle_at(place, piece_around(pass)),
                 near = angle_at(place, {pass.first, pass.last + 2});
    return turn.below(std::numbers::pi + here - near, first, from, last, to);
}

bool OtherSides::take(const Pass& pass, const Turn::Fan& fan, PointRange range) {
    constexpr double SHORTER = 1e-12; // as a share: less is rounding
    copy_part(surface_, way_.strip, way_.path, range, other_.strip);
    turn_around(other_.strip, {pass.first - range.first, pass.last - range.first, pass.vertex}, fan);
    straightening_.straighten(other_);
    const double before = length(range);
    if (!(other_.path.length < before * (1 - SHORTER))) return false;
    straightening_.replace_part(way_, range, other_, before);
    straightening_.turn_bends(way_);
    measure();
    return true;
}

// Between the bends, and one farther, since a bend may go. Gives the first portal of the part if it helped.
std::optional<size_t> OtherSides::try_at(const Pass& pass) {
    const auto place = place_to_pass(pass);
    if (!place) return std::nullopt;
    const PointRange range = with_next_pieces(piece_around(pass));
    const double rounded = double{static_cast<float>(length(range))};
    const std::tuple key(pass.vertex, way_.strip.faces[pass.first], rounded);
    if (failed_.contains(key)) return std::nullopt;
    const auto fan = other_side(pass, *place);
    if (!fan) return std::nullopt;
    ++tries_;
    if (take(pass, *fan, range)) return range.first;
    failed_.insert(key);
    return std::nullopt;
}

// Once along the strip; after a change on from where that begins.
bool OtherSides::sweep() {
    constexpr size_t MOST_TRIES = 1000;
    bool has_helped = false;
    for (size_t i = 0; i < way_.strip.portals.size();) {
        std::optional<size_t> changed;
        const auto [a, b] = way_.strip.portals[i];
        for (const uint32_t vertex : {a, b})
            if (!changed && tries_ < MOST_TRIES && is_begin(i, vertex)) changed = try_at(pass_of(i, vertex));
        has_helped |= changed.has_value();
        i = changed.value_or(i + 1);
    }
    return has_helped;
}

void OtherSides::run(StripWay& way) {
    constexpr int MOST_SWEEPS = 4;
    std::swap(way, way_);
    tries_ = 0;
    measure();
    for (int i = 0; i < MOST_SWEEPS && sweep(); ++i) {
    }
    std::swap(way, way_);
}

}

void try_other_sides(const Surface& surface, std::span<StripWay> ways) {
    OtherSides sides(surface);
    for (StripWay& way : ways) sides.run(way);
}

}
