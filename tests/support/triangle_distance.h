#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace geodesic::test {

// How far a position is from a triangle, be it a needle: from a side, or from the plane beside its inside.
inline double distance_from_triangle(const std::array<Eigen::Vector3d, 3>& corners,
                                     const Eigen::Vector3d& at) {
    const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    double least = std::numeric_limits<double>::infinity();
    bool is_inside = true;
    for (size_t k = 0; k < 3; ++k) {
        const Eigen::Vector3d side = corners[(k + 1) % 3] - corners[k], to = at - corners[k];
        const double square = side.squaredNorm();
        const double share = square > 0 ? std::clamp(to.dot(side) / square, 0.0, 1.0) : 0;
        least = std::min(least, (to - share * side).norm());
        is_inside = is_inside && side.cross(to).dot(normal) > 0;
    }
    return is_inside ? std::min(least, std::abs((at - corners[0]).dot(normal)) / normal.norm()) : least;
}

}
