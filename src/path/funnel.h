#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace geodesic {

// The shortest ways from the source to both ends of a gate: together up to the apex, from there along a chain
// to each end (Lee and Preparata 1984). begin() makes it ready for another source.
class Funnel {
public:
    // A point where the way may bend: an end of a gate that was added there, or an end of the way.
    struct Point {
        Eigen::Vector2d at;
        uint32_t vertex;       // NONE of an end of the way
        uint32_t gate, before; // `before` is the index of the point before it on the shortest way
    };

    // So many points may be added.
    void begin(const Eigen::Vector2d& source, size_t count);

    // The next point that a side comes to, at a gate. Gives its index in points().
    uint32_t add_left(const Eigen::Vector2d& at, uint32_t vertex, uint32_t gate);
    uint32_t add_right(const Eigen::Vector2d& at, uint32_t vertex, uint32_t gate);

    // The source, and the points that were added, in their order.
    std::span<const Point> points() const { return std::span(points_).first(count_); }

private:
    double turn(uint32_t first, uint32_t second, const Eigen::Vector2d& at) const;
    double turn_or_rounding(double turn, const Eigen::Vector2d& way, const Eigen::Vector2d& on) const;
    void reach(const Eigen::Vector2d& at);
    uint32_t add(const Eigen::Vector2d& at, uint32_t vertex, uint32_t gate, uint32_t before);

    static constexpr double ROUNDING = 1e-14; // as a share of positions

    double farthest_ = 0;       // of all positions, from the origin
    double most_rounding_ = 0;  // of a turn at these positions
    std::vector<Point> points_; // room for all that may be added
    uint32_t count_ = 0;
    // Indices of points: the chain to the left end, from the end back to the apex, and then that to the
    // right end.
    std::vector<uint32_t> chain_;
    size_t left_ = 0, apex_ = 0, right_ = 0; // in chain_
};

}
