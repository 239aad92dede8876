#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

namespace geodesic {

// Of two directions, neither of them zero: exact to rounding, also where they are nearly the same or
// opposite.
inline double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

// Adds up angles between directions, with one arc tangent for all of them.
class AngleSum {
public:
    void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
        const double along = a.dot(b), across = a.cross(b).norm();
        const double x = x_ * along - y_ * across, y = x_ * across + y_ * along;
        const double size = std::abs(x) + std::abs(y);
        if (!(size > 0 && size <= std::numeric_limits<double>::max()))
            return; // no direction, or one too long to tell
        x_ = x / size;
        y_ = y / size;
        const bool was_past_half = std::exchange(is_past_half_, y_ < 0 || (y_ == 0 && x_ < 0));
        whole_turns_ += was_past_half && !is_past_half_; // no angle is more than half a turn
    }
    double value() const {
        const double rest = std::atan2(y_, x_);
        return 2 * std::numbers::pi * (whole_turns_ + (rest < 0 ? 1 : 0)) + rest;
    }

    // Whether it is half a turn or more.
    bool is_half_turn() const { return whole_turns_ > 0 || is_past_half_; }

private:
    double x_ = 1, y_ = 0;      // the sum without whole turns, as a direction
    bool is_past_half_ = false; // whether that is half a turn or more
    int whole_turns_ = 0;
};

}
