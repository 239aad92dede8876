#include "src/path/straighten.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace geodesic {

namespace {

using Eigen::Vector3d;

uint32_t vertex_of(const StripWay& way, size_t portal) {
    return vertex_at(way.strip.portals[portal], way.path.shares[portal]);
}

// The next vertex that the path passes, from a portal on. It may be an end of the path.
std::optional<Pass> next_pass(const StripWay& way, size_t from) {
    const size_t portals = way.strip.portals.size();
    for (size_t i = from; i < portals; ++i) {
        const uint32_t vertex = vertex_of(way, i);
        if (vertex == NONE) continue;
        size_t last = i;
        while (last + 1 < portals && vertex_of(way, last + 1) == vertex) ++last;
        return Pass{i, last, vertex};
    }
    return std::nullopt;
}

PointRange between_bends(const StripWay& way, const Pass& pass) {
    PointRange range{pass.first, pass.last + 2};
    while (range.first > 0 && vertex_of(way, range.first - 1) == NONE) --range.first;
    while (range.last <= way.strip.portals.size() && vertex_of(way, range.last - 1) == NONE) ++range.last;
    return range;
}

double length(const Surface& surface, const StripWay& way, PointRange range) {
    const auto& [strip, path] = way;
    const size_t first = range.first, count = range.last - range.first - 1;
    return length_over(
        surface, position_before(surface, strip, path, first),
        {std::span(strip.portals).subspan(first, count), std::span(path.shares).subspan(first, count)},
        position_after(surface, strip, path, range.last - 2));
}

// The first portal at the vertex that the path passes at a point, if it does; the portal there if not.
size_t first_portal_at(const StripWay& way, size_t point) {
    size_t portal = point > 0 ? point - 1 : 0;
    while (portal > 0 && vertex_of(way, portal) != NONE &&
           vertex_of(way, portal - 1) == vertex_of(way, portal))
        --portal;
    return portal;
}

}

void turn_around(Strip& strip, const Pass& pass, const Turn::Fan& fan) {
    std::vector<Portal> portals;
    for (const uint32_t spoke : fan.spokes) portals.push_back({pass.vertex, spoke});
    const bool is_one_face = portals.empty();
    replace(strip.faces, {pass.first + 1, pass.last + (is_one_face ? 2 : 1)}, fan.faces);
    replace(strip.portals, {pass.first, pass.last + 1}, portals);
    drop_returns(strip, {pass.first, pass.first + portals.size()});
}

// Another way around the vertex of a pass, or nothing if the path is straight enough there.
std::optional<Turn::Fan> Straightening::shorter_side(const StripWay& way, const Pass& pass) const {
    constexpr double ROUNDING = 1e-8;
    const Vector3d at = surface_.positions[pass.vertex];
    const Vector3d from = position_before(surface_, way.strip, way.path, pass.first) - at,
                   to = position_after(surface_, way.strip, way.path, pass.last) - at;
    if (from.isZero(0) || to.isZero(0)) return std::nullopt;
    const uint32_t first = way.strip.faces[pass.first], last = way.strip.faces[pass.last + 1];
    if (first == last) return Turn::Fan{};
    const ClosedFan closed(surface_, pass.vertex, first);
    if (closed.is_closed()) return closed.below(std::numbers::pi - ROUNDING, from, last, to);
    return Turn(surface_, pass.vertex).below(std::numbers::pi - ROUNDING, first, from, last, to);
}

// Turns the strip if that makes the path shorter, and returns the portal to go on from then.
std::optional<size_t> Straightening::turn(StripWay& way, const Pass& pass) {
    const auto fan = shorter_side(way, pass);
    if (!fan) return std::nullopt;
    const PointRange range = between_bends(way, pass);
    copy_part(surface_, way.strip, way.path, range, part_.strip);
    turn_around(part_.strip, {pass.first - range.first, pass.last - range.first, pass.vertex}, *fan);
    tight_paths_.pull_tight(part_.strip, part_.path);
    const double before = length(surface_, way, range);
    if (!(part_.path.length < before - way.path.length * SHORTER)) return std::nullopt;
    return replace_part(way, range, part_, before);
}

size_t Straightening::replace_part(StripWay& way, PointRange range, const StripWay& part,
                                   double length_before) {
    auto& [strip, path] = way;
    const Replaced portals{range.first, range.last - 1};
    const size_t end = range.first + part.strip.portals.size();
    replace(strip.faces, {range.first, range.last}, part.strip.faces);
    replace(strip.portals, portals, part.strip.portals);
    const size_t count = strip.portals.size();
    drop_returns(strip, {range.first, end});
    if (strip.portals.size() != count) { // faces at the ends of the part
        tight_paths_.pull_tight(strip, path);
        is_straight_.clear();
        return 0;
    }
    replace(path.shares, portals, part.path.shares);
    path.length += part.path.length - length_before;
    const size_t first = first_portal_at(way, range.first);
    for (size_t i = first; i < std::min(end + 1, count); ++i)
        if (vertex_of(way, i) != NONE) is_straight_[strip.faces[i]] = false;
    return first;
}

void Straightening::turn_bends(StripWay& way) {
    is_straight_.clear();
    size_t next = 0;
    while (const auto pass = next_pass(way, next)) {
        next = pass->last + 1;
        if (std::exchange(is_straight_[way.strip.faces[pass->first]], true)) continue;
        if (const auto first = turn(way, *pass)) next = *first;
    }
}

void Straightening::straighten(StripWay& way) {
    tight_paths_.pull_tight(way.strip, way.path);
    turn_bends(way);
}

StripWay straighten(const Surface& surface, Strip&& strip) {
    StripWay way{std::move(strip), {}};
    Straightening(surface).straighten(way);
    return way;
}

}
