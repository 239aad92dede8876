#pragma once

#include <vector>

#include "src/path/strip.h"

namespace geodesic {

// A portal in the plane, its ends named as whoever goes through it sees them.
struct Gate {
    uint32_t left_vertex, right_vertex;
    Eigen::Vector2d left, right;
};

// The shortest ways from the source to both ends of a gate: together up to the apex, from there along a chain
// to each end (Lee and Preparata 1984). begin() makes it ready for another source.
class Funnel {
public:
    // A point where the way may bend: an end of a gate that was added there, or an end of the way.
    struct Point {
        Eigen::Vector2d at;
        uint32_t vertex;     // NONE of an end of the way
        size_t gate, before; // `before` is the position of the point before it on the shortest way
    };

    // So many points may be added.
    void begin(const Eigen::Vector2d& source, size_t count);

    // The next point that a side comes to, at a gate.
    void add_left(const Eigen::Vector2d& at, uint32_t vertex, size_t gate);
    void add_right(const Eigen::Vector2d& at, uint32_t vertex, size_t gate);

    // The source, and the points that were added, in their order.
    const std::vector<Point>& points() const { return points_; }

private:
    double turn(size_t first, size_t second, const Eigen::Vector2d& at) const;
    size_t add(const Point& point);

    double farthest_ = 0; // of all positions, from the origin
    std::vector<Point> points_;
    // Positions of points: the chain to the left end, from the end back to the apex, and then that to the
    // right end.
    std::vector<size_t> chain_;
    size_t left_ = 0, apex_ = 0, right_ = 0; // in chain_
};

// Finds the shortest paths in strips: between two portals that are vertices the strip is unfolded into the
// plane, and the path pulled tight there. It keeps its arrays from one strip to the next.
class TightPaths {
public:
    explicit TightPaths(const Surface& surface) : surface_(surface) {}

    void pull_tight(const Strip& strip, StripPath& path);

private:
    struct Part;
    void unfold(const Strip& strip, const Part& part);
    void widen_funnel();
    void find_bends();
    void add_shares(std::span<const Portal> portals, std::vector<double>& shares) const;

    const Surface& surface_;
    std::vector<Gate> gates_;
    Funnel funnel_;
    std::vector<size_t> bends_; // the points of the funnel where the way bends, and its ends
};

}
