#include "src/path/straighten.h"

#include <algorithm>
#include <numbers>
#include <optional>
#include <unordered_set>

#include "src/path/funnel.h"
#include "src/path/turn.h"

namespace geodesic {

namespace {

using Eigen::Vector3d;

// Another way around the vertex of a pass, or nothing if the path is straight enough there.
std::optional<Turn::Fan> shorter_side(const Surface& surface, const Strip& strip, const StripPath& path,
                                      const Pass& pass) {
    constexpr double ROUNDING = 1e-8;
    const Vector3d at = surface.positions[pass.vertex];
    const Vector3d from = position_before(surface, strip, path, pass.first) - at,
                   to = position_after(surface, strip, path, pass.last) - at;
    if (from.isZero(0) || to.isZero(0)) return std::nullopt;
    const uint32_t first = strip.faces[pass.first], last = strip.faces[pass.last + 1];
    if (first == last) return Turn::Fan{};
    return Turn(surface, pass.vertex).below(std::numbers::pi - ROUNDING, first, from, last, to);
}

// A strip whose path is made straight turn by turn. A turn changes the path between the bends before and
// after it alone, so only that part is pulled tight again.
class Straightening {
public:
    Straightening(const Surface& surface, Strip& strip)
        : surface_(surface), strip_(strip), path_(shortest_in_strip(surface, strip)) {}

    StripPath run(double limit);

private:
    static constexpr double SHORTER = 1e-13; // as a share of the path: less is rounding

    uint32_t vertex_of(size_t portal) const {
        return vertex_at(strip_.portals[portal], path_.shares[portal]);
    }
    std::optional<Pass> next_pass(size_t from) const;
    PointRange between_bends(const Pass& pass) const;
    double length(PointRange range) const;
    std::optional<size_t> turn(const Pass& pass);
    size_t replace(PointRange range, const Strip& part, const StripPath& path, double length_before);
    size_t first_portal_at(size_t point) const;
    bool turn_all();

    const Surface& surface_;
    Strip& strip_;
    StripPath path_;
    std::unordered_set<uint32_t> straight_; // vertices where no turn helps as long as the path there stays
};

// The next vertex that the path passes, from a portal on. It may be an end of the path.
std::optional<Pass> Straightening::next_pass(size_t from) const {
    for (size_t i = from; i < strip_.portals.size(); ++i) {
        const uint32_t vertex = vertex_of(i);
        if (vertex == NONE) continue;
        size_t last = i;
        while (last + 1 < strip_.portals.size() && vertex_of(last + 1) == vertex) ++last;
        return Pass{i, last, vertex};
    }
    return std::nullopt;
}

PointRange Straightening::between_bends(const Pass& pass) const {
    PointRange range{pass.first, pass.last + 2};
    while (range.first > 0 && vertex_of(range.first - 1) == NONE) --range.first;
    while (range.last <= strip_.portals.size() && vertex_of(range.last - 1) == NONE) ++range.last;
    return range;
}

double Straightening::length(PointRange range) const {
    const auto position = [&](size_t point) {
        return point <= strip_.portals.size() ? position_before(surface_, strip_, path_, point)
                                              : position_of(surface_, strip_.target);
    };
    double length = 0;
    Vector3d last = position(range.first);
    for (size_t point = range.first + 1; point <= range.last; ++point) {
        const Vector3d next = position(point);
        length += (next - last).norm();
        last = next;
    }
    return length;
}

// Puts a part in the place of its range, and returns the portal to go on from: the first one that the path
// may pass in another way now.
size_t Straightening::replace(PointRange range, const Strip& part, const StripPath& path,
                              double length_before) {
    const size_t portals = strip_.portals.size() - (range.last - 1 - range.first) + part.portals.size();
    strip_ = with_part(strip_, range, part);
    if (strip_.portals.size() != portals) { // faces at the ends of the part were dropped
        path_ = shortest_in_strip(surface_, strip_);
        straight_.clear();
        return 0;
    }
    const auto at = path_.shares.begin() + static_cast<std::ptrdiff_t>(range.first);
    const auto behind =
        path_.shares.erase(at, at + static_cast<std::ptrdiff_t>(range.last - 1 - range.first));
    path_.shares.insert(behind, path.shares.begin(), path.shares.end());
    path_.length += path.length - length_before;
    const size_t end = range.first + part.portals.size();
    for (size_t i = range.first > 0 ? range.first - 1 : 0; i < std::min(end + 1, portals); ++i)
        straight_.erase(vertex_of(i));
    return first_portal_at(range.first);
}

// The first portal at the vertex that the path passes at a point, if it does; the portal there if not.
size_t Straightening::first_portal_at(size_t point) const {
    size_t portal = point > 0 ? point - 1 : 0;
    while (portal > 0 && vertex_of(portal) != NONE && vertex_of(portal - 1) == vertex_of(portal)) --portal;
    return portal;
}

// Turns the strip if that makes the path shorter, and returns the portal to go on from then.
std::optional<size_t> Straightening::turn(const Pass& pass) {
    const auto fan = shorter_side(surface_, strip_, path_, pass);
    if (!fan) return std::nullopt;
    const PointRange range = between_bends(pass);
    const Strip part = with_fan(part_of(surface_, strip_, path_, range),
                                {pass.first - range.first, pass.last - range.first, pass.vertex}, *fan);
    const StripPath shorter = shortest_in_strip(surface_, part);
    const double before = length(range);
    if (!(shorter.length < before - path_.length * SHORTER)) return std::nullopt;
    return replace(range, part, shorter, before);
}

// Returns whether any turn was made.
bool Straightening::turn_all() {
    bool has_turned = false;
    for (size_t next = 0;;) {
        const auto pass = next_pass(next);
        if (!pass) return has_turned;
        next = pass->last + 1;
        if (!straight_.insert(pass->vertex).second) continue;
        if (const auto first = turn(*pass)) {
            next = *first;
            has_turned = true;
        }
    }
}

// Each part is as short as it can be. The whole path is pulled tight once more, since the last turns may have
// made a bend between two parts unnecessary.
StripPath Straightening::run(double limit) {
    while (turn_all() && path_.length < limit) {
        StripPath whole = shortest_in_strip(surface_, strip_);
        const bool is_shorter = whole.length < path_.length * (1 - SHORTER);
        path_ = std::move(whole);
        if (!is_shorter) break;
        straight_.clear();
    }
    return std::move(path_);
}

}

Strip with_fan(const Strip& strip, const Pass& pass, const Turn::Fan& fan) {
    std::vector<Portal> portals;
    for (const uint32_t spoke : fan.spokes) portals.push_back({pass.vertex, spoke});
    const bool is_one_face = portals.empty();
    return with_part(strip, {pass.first + 1, pass.last + (is_one_face ? 2 : 1)}, fan.faces,
                     {pass.first, pass.last + 1}, portals);
}

StripPath straighten(const Surface& surface, Strip& strip, double limit) {
    return Straightening(surface, strip).run(limit);
}

}
