#include "src/path/strip.h"

#include <algorithm>

namespace geodesic {

using Eigen::Vector3d;

Vector3d position_at(const Surface& surface, const Portal& portal, double share) {
    return (1 - share) * surface.positions[portal.a] + share * surface.positions[portal.b];
}

SurfacePoint point_at(const Surface& surface, uint32_t face, const Portal& portal, double share) {
    SurfacePoint point{face, {}};
    point.weights[corner_of(surface, face, portal.a)] += 1 - share;
    point.weights[corner_of(surface, face, portal.b)] += share;
    return point;
}

uint32_t vertex_at(const Portal& portal, double share) {
    return share == 0 ? portal.a : share == 1 ? portal.b : NONE;
}

Vector3d position_before(const Surface& surface, const Strip& strip, const StripPath& path, size_t i) {
    return i == 0 ? position_of(surface, strip.source)
                  : position_at(surface, strip.portals[i - 1], path.shares[i - 1]);
}

Vector3d position_after(const Surface& surface, const Strip& strip, const StripPath& path, size_t i) {
    return i + 1 == strip.portals.size() ? position_of(surface, strip.target)
                                         : position_at(surface, strip.portals[i + 1], path.shares[i + 1]);
}

double length_of(const Surface& surface, const Strip& strip, const std::vector<double>& shares) {
    Vector3d last = position_of(surface, strip.source);
    double length = 0;
    for (size_t i = 0; i < shares.size(); ++i) {
        const Vector3d next = position_at(surface, strip.portals[i], shares[i]);
        length += (next - last).norm();
        last = next;
    }
    return length + (position_of(surface, strip.target) - last).norm();
}

Strip with_replaced(const Strip& strip, Replaced faces, const std::vector<uint32_t>& new_faces,
                    Replaced portals, const std::vector<Portal>& new_portals) {
    Strip whole{strip.source, strip.target, {}, {}};
    const auto join = [](auto& all, const auto& old, Replaced part, const auto& own) {
        all.assign(old.begin(), old.begin() + static_cast<std::ptrdiff_t>(part.first));
        all.insert(all.end(), own.begin(), own.end());
        all.insert(all.end(), old.begin() + static_cast<std::ptrdiff_t>(part.last), old.end());
    };
    join(whole.faces, strip.faces, faces, new_faces);
    join(whole.portals, strip.portals, portals, new_portals);
    return whole;
}

Strip with_part(const Strip& strip, Replaced faces, const std::vector<uint32_t>& new_faces, Replaced portals,
                const std::vector<Portal>& new_portals) {
    Strip whole = with_replaced(strip, faces, new_faces, portals, new_portals);
    drop_returns(whole);
    return whole;
}

Strip part_of(const Surface& surface, const Strip& strip, const StripPath& path, PointRange range) {
    const auto [first, last] = range;
    const auto offset = [](size_t i) { return static_cast<std::ptrdiff_t>(i); };
    Strip part{strip.source, strip.target, {}, {}};
    part.faces.assign(strip.faces.begin() + offset(first), strip.faces.begin() + offset(last));
    part.portals.assign(strip.portals.begin() + offset(first), strip.portals.begin() + offset(last - 1));
    const auto portal_point = [&](size_t face, size_t portal) {
        return point_at(surface, strip.faces[face], strip.portals[portal], path.shares[portal]);
    };
    if (first > 0) part.source = portal_point(first, first - 1);
    if (last <= strip.portals.size()) part.target = portal_point(last - 1, last - 1);
    return part;
}

Strip with_part(const Strip& strip, PointRange range, const Strip& part) {
    return with_part(strip, {range.first, range.last}, part.faces, {range.first, range.last - 1},
                     part.portals);
}

void turn_back(Strip& strip) {
    std::swap(strip.source, strip.target);
    std::ranges::reverse(strip.faces);
    std::ranges::reverse(strip.portals);
}

void drop_returns(Strip& strip) {
    for (size_t i = 0; i + 1 < strip.portals.size();) {
        const Portal entry = strip.portals[i], exit = strip.portals[i + 1];
        const bool comes_back = strip.faces[i] == strip.faces[i + 2];
        if (!entry.joins(exit) || (!comes_back && !exit.joins(entry))) {
            ++i;
            continue;
        }
        const auto at = static_cast<std::ptrdiff_t>(i), count = std::ptrdiff_t{comes_back ? 2 : 1};
        strip.faces.erase(strip.faces.begin() + at + 1, strip.faces.begin() + at + 1 + count);
        strip.portals.erase(strip.portals.begin() + at, strip.portals.begin() + at + count);
        if (i > 0) --i;
    }
}

}
