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
    // Whether it is the same edge, or an edge at the end of which that vertex is.
    bool covers(const Portal& other) const { return contains(other.a) && contains(other.b); }
    bool operator==(const Portal&) const = default;
};

// The faces that a path passes, portal i from face i into face i + 1, so that there is one portal less, and
// its ends, which are points of the first and of the last face.
struct Strip {
    SurfacePoint source, target;
    std::vector<uint32_t> faces;
    std::vector<Portal> portals;
};

// Of two strips with the same ends.
inline bool is_same_strip(const Strip& a, const Strip& b) {
    return a.faces == b.faces && a.portals == b.portals;
}

// A path in a strip: shares[i] tells where it passes portal i, from 0 at `a` to 1 at `b`. By the exact metric
// it bends only where a share is 0 or 1.
struct StripPath {
    std::vector<double> shares;
    double length = 0;
};

// A strip and a path in it, which has a share for each portal.
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

// The position of the path before portal i (the source if i is 0), and after it. Where i is the number of
// portals, what is before it is the begin of the last face.
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

// Items of an array that others take the place of, without that at `end`.
struct Replaced {
    size_t begin, end;
};

// Puts other items in the place of some.
template <class T>
void replace(std::vector<T>& all, Replaced old, const std::vector<T>& own) {
    const auto at = [&](size_t i) { return all.begin() + static_cast<std::ptrdiff_t>(i); };
    const size_t kept = std::min(old.end - old.begin, own.size());
    const auto rest = own.begin() + static_cast<std::ptrdiff_t>(kept);
    std::copy(own.begin(), rest, at(old.begin));
    all.erase(at(old.begin + kept), at(old.end));
    all.insert(at(old.begin + kept), rest, own.end());
}

// The points of a path are numbered: its source, where it passes each portal of its strip, its target. Face i
// lies between points i and i + 1. A range has both its ends, and last > first: it stands for faces
// first .. last - 1 and portals first .. last - 2 between these.
struct PointRange {
    size_t first, last;
};

// Fills `part` with the strip between two points of its path.
void copy_part(const Surface& surface, const Strip& strip, const StripPath& path, PointRange range,
               Strip& part);

// From its target to its source.
void turn_back(Strip& strip);

// Takes out what leads back through one portal: a face that is entered and left there, or two faces of which
// the second is the one before the first. Looks at pairs of portals in a row of which one at least is among
// these, which are new.
void drop_returns(Strip& strip, Replaced portals);

}
