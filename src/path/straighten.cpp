#include "src/path/straighten.h"

#include <numbers>
#include <optional>
#include <unordered_set>

#include "src/path/funnel.h"
#include "src/path/turn.h"

namespace geodesic {

namespace {

using Eigen::Vector3d;

// The next vertex that a path passes, from a portal on, but for its ends.
std::optional<Pass> next_pass(const Strip& strip, const StripPath& path, size_t from) {
    for (size_t i = from; i < strip.portals.size(); ++i) {
        const uint32_t vertex = vertex_at(strip.portals[i], path.shares[i]);
        if (vertex == NONE) continue;
        size_t last = i;
        while (last + 1 < strip.portals.size() &&
               vertex_at(strip.portals[last + 1], path.shares[last + 1]) == vertex)
            ++last;
        return Pass{i, last, vertex};
    }
    return std::nullopt;
}

// The strip with another way around the vertex of a pass, or nothing if the path is straight enough there.
std::optional<Strip> turned(const Surface& surface, const Strip& strip, const StripPath& path,
                            const Pass& pass) {
    constexpr double ROUNDING = 1e-8;
    const Vector3d at = surface.positions[pass.vertex];
    const Vector3d from = position_before(surface, strip, path, pass.first) - at,
                   to = position_after(surface, strip, path, pass.last) - at;
    if (from.isZero(0) || to.isZero(0)) return std::nullopt;
    const uint32_t first = strip.faces[pass.first], last = strip.faces[pass.last + 1];
    if (first == last) return with_fan(strip, pass, {});
    const auto fan = Turn(surface, pass.vertex).below(std::numbers::pi - ROUNDING, first, from, last, to);
    return fan ? std::optional(with_fan(strip, pass, *fan)) : std::nullopt;
}

}

Strip with_fan(const Strip& strip, const Pass& pass, const Turn::Fan& fan) {
    std::vector<Portal> portals;
    for (const uint32_t spoke : fan.spokes) portals.push_back({pass.vertex, spoke});
    const bool is_one_face = portals.empty();
    return with_part(strip, {pass.first + 1, pass.last + (is_one_face ? 2 : 1)}, fan.faces,
                     {pass.first, pass.last + 1}, portals);
}

StripPath straighten(const Surface& surface, Strip& strip) {
    constexpr double SHORTER = 1e-13; // as a share: less is rounding
    StripPath path = shortest_in_strip(surface, strip);
    std::unordered_set<uint32_t> straight; // vertices where no turn has helped since the last one that did
    for (size_t from = 0;;) {
        const auto pass = next_pass(strip, path, from);
        if (!pass) return path;
        from = pass->last + 1;
        if (straight.contains(pass->vertex)) continue;
        straight.insert(pass->vertex);
        auto other = turned(surface, strip, path, *pass);
        if (!other) continue;
        StripPath shorter = shortest_in_strip(surface, *other);
        if (!(shorter.length < path.length * (1 - SHORTER))) continue;
        strip = std::move(*other);
        path = std::move(shorter);
        straight.clear();
        from = 0;
    }
}

}
