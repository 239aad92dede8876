#include "src/path/strip.h"

#include <algorithm>

namespace geodesic {

using Eigen::Vector3d;

SurfacePoint point_at(const Surface& surface, uint32_t face, const Portal& portal, double share) {
    SurfacePoint point{face, {}};
    point.weights[corner_of(surface, face, portal.a)] += 1 - share;
    point.weights[corner_of(surface, face, portal.b)] += share;
    return point;
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
    return length_over(surface, position_of(surface, strip.source), {strip.portals, shares},
                       position_of(surface, strip.target));
}

double length_over(const Surface& surface, const Vector3d& from, const PassedPortals& passed,
                   const Vector3d& to) {
    Vector3d last = from;
    double length = 0;
    for (size_t i = 0; i < passed.shares.size(); ++i) {
        const Vector3d next = position_at(surface, passed.portals[i], passed.shares[i]);
        length += (next - last).norm();
        last = next;
    }
    return length + (to - last).norm();
}

void copy_part(const Surface& surface, const Strip& strip, const StripPath& path, PointRange range,
               Strip& part) {
    const auto [first, last] = range;
    const auto offset = [](size_t i) { return static_cast<std::ptrdiff_t>(i); };
    part.faces.assign(strip.faces.begin() + offset(first), strip.faces.begin() + offset(last));
    part.portals.assign(strip.portals.begin() + offset(first), strip.portals.begin() + offset(last - 1));
    const auto portal_point = [&](size_t face, size_t portal) {
        return point_at(surface, strip.faces[face], strip.portals[portal], path.shares[portal]);
    };
    part.source = first > 0 ? portal_point(first, first - 1) : strip.source;
    part.target = last <= strip.portals.size() ? portal_point(last - 1, last - 1) : strip.target;
}

void turn_back(Strip& strip) {
    std::swap(strip.source, strip.target);
    std::ranges::reverse(strip.faces);
    std::ranges::reverse(strip.portals);
}

void drop_returns(Strip& strip, Replaced portals) {
    size_t i = portals.begin - std::min<size_t>(portals.begin, 1), end = portals.end;
    while (i < end && i + 1 < strip.portals.size()) {
        const Portal entry = strip.portals[i], exit = strip.portals[i + 1];
        const bool comes_back = strip.faces[i] == strip.faces[i + 2];
        const bool entry_covers = entry.covers(exit), exit_covers = exit.covers(entry);
        if (comes_back ? !entry_covers && !exit_covers : !entry_covers || !exit_covers) {
            ++i;
            continue;
        }
        const size_t count = comes_back ? 2 : 1;
        replace(strip.faces, {i + 1, i + 1 + count}, {});
        replace(strip.portals, {i, i + count}, {});
        end = std::max(i, end - std::min(end, count));
        if (i > 0) --i;
    }
}

}
