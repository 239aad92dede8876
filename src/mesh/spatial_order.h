#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace geodesic {

// The given points (indices of `positions`) along a Z-order curve through their bounding box: what is near in
// space is mostly near in memory. Points of one cell of the curve keep their order.
std::vector<uint32_t> spatial_order(std::span<const Eigen::Vector3d> positions, std::vector<uint32_t> points);

}
