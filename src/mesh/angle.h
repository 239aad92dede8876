#pragma once

#include <cmath>

#include <Eigen/Geometry>

namespace geodesic {

// Of two directions, neither of them zero: exact to rounding, also where they are nearly the same or
// opposite.
inline double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

}
