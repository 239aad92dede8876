#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "src/surface/surface.h"

namespace geodesic {

// Where a path passes from a face into the next one: the edge between two vertices, or a vertex, given twice.
struct Portal {
    uint32_t a, b;

    bool contains(uint32_t vertex) const { return vertex == a || vertex == b; }
    bool is_vertex() const { return a == b; }
    bool joins(const Portal& other) const { return contains(other.a) && contains(other.b); }
    bool operator==(const Portal&) const = default;
};

// The faces that a path passes, portal i from face i into face i + 1, and its ends, which are points of the
// first and of the last face.
struct Strip {
    SurfacePoint source, target;
    std::vector<uint32_t> faces;
    std::vector<Portal> portals;
};

// A path in a strip: shares[i] tells where it passes portal i, from 0 at `a` to 1 at `b`. By the exact metric
// it bends only where a share is 0 or 1.
struct StripPath {
    std::vector<double> shares;
    double length = 0;
};

struct StripWay {
    Strip strip;
    StripPath path;
};

inline Eigen::Vector3d position_at(const Surface& surface, const Portal& portal, double share) {
    return (1 - share) * surface.positions[portal.a] + share * surface.positions[portal.b];
}

// The same as a point of a face at the portal.
SurfacePoint point_at(const Surface& surface, uint32_t face, const Portal& portal, double share);

// The vertex where a path passes a portal, or NONE if it passes between two.
inline uint32_t vertex_at(const Portal& portal, double share) {
    return share == 0 ? portal.a : share == 1 ? portal.b : NONE;
}

// The position of the path before portal i (the source if i is 0), and after it.
Eigen::Vector3d position_before(const Surface& surface, const Strip& strip, const StripPath& path, size_t i);
Eigen::Vector3d position_after(const Surface& surface, const Strip& strip, const StripPath& path, size_t i);

// The sum of the lengths of the pieces, by positions in space.
double length_of(const Surface& surface, const Strip& strip, const std::vector<double>& shares);

// Points of a path between two others, at some portals in a row.
struct PassedPortals {
    std::span<const Portal> portals;
    std::span<const double> shares;
};

// The same from one position over these points to another position.
double length_over(const Surface& surface, const Eigen::Vector3d& from, const PassedPortals& passed,
                   const Eigen::Vector3d& to);

// Positions from the first one up to, but without, the last one.
struct Replaced {
    size_t first, last;
};

// Puts other items in the place of some.
template <class T>
void replace(std::vector<T>& all, Replaced old, const std::vector<T>& own) {
    const auto at = [&](size_t i) { return all.begin() + static_cast<std::ptrdiff_t>(i); };
    const size_t kept = std::min(old.last - old.first, own.size());
    const auto rest = own.begin() + static_cast<std::ptrdiff_t>(kept);
    std::copy(own.begin(), rest, at(old.first));
    all.erase(at(old.first + kept), at(old.last));
    all.insert(at(old.first + kept), rest, own.end());
}

// The points of a path are numbered: its source, where it passes each portal of its strip, its target. Face i
// lies between points i and i + 1. A range of points stands for the faces between its ends.
struct PointRange {
    size_t first, last;
};

// Fills `part` with the strip between two points of its path.
void copy_part(const Surface& surface, const Strip& strip, const StripPath& path, PointRange range,
               Strip& part);

// From its target to its source.
void turn_back(Strip& strip);

// Takes out faces that are left through the portal that they were entered by, where these portals are new.
void drop_returns(Strip& strip, Replaced portals);

}
