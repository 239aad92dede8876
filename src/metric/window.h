#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace geodesic {

// The part of an edge that straight paths from one (pseudo-)source reach through one sequence of faces. In
// the plane of the edge (first vertex at 0, on the x axis) the source lies at (x, y), y >= 0; the distance at
// t is sigma + |(t, 0) - (x, y)|.
struct Window {
    double begin, end; // on the edge, begin < end
    double x, y;
    double sigma;                        // distance of the pseudo-source
    double begin_distance, end_distance; // at the two ends
    uint32_t from_face;                  // the paths arrive through this face and go on into the others
    uint32_t nearest : 31;               // position of the source among the sources of the solve
    uint32_t pending : 1;                // not propagated yet

    double distance_at(double t) const { return sigma + std::sqrt((t - x) * (t - x) + y * y); }

    // Where the straight line from the source to (tx, -depth) crosses the line of the edge.
    double split_to(double tx, double depth) const {
        const double height = y + depth;
        return height > 0 ? x + (tx - x) * (y / height) : tx;
    }
    // Where the shortest path over the window to that point crosses the edge: there if that is in the window,
    // else around its nearer end.
    double crossing_to(double tx, double depth) const { return std::clamp(split_to(tx, depth), begin, end); }

    double smallest_distance() const {
        if (x < begin) return begin_distance;
        if (x > end) return end_distance;
        return sigma + y;
    }
};

// Where a window is lower than another on an interval: on [begin, end], empty if begin >= end.
struct Advantage {
    double begin, end;
    bool inside_out; // lower outside of (begin, end) instead
};

// One window for two, of which b begins where a ends. They may see the same source, but for rounding: light
// that passes a vertex of a flat part of the surface on both sides comes together again behind it. Else, with
// a tolerance, what both see may become one, as in the approximation of Surazhsky et al. 2005. The source is
// then where the outer rays of the two meet, so that behind the edge no place falls out of the light. Nothing
// if these do not meet, if a distance at an end of either would change by more than this share of itself, or
// if the two are not propagated alike.
std::optional<Window> join_windows(const Window& a, const Window& b, double tolerance);

inline constexpr uint32_t MAX_NEAREST = UINT32_MAX >> 1;

// Compares two windows on [s, t], which both cover. `challenger` must be lower by more than rounding to win.
Advantage advantage(const Window& challenger, const Window& holder, double s, double t);

}
