#pragma once

#include <vector>

#include <Eigen/Core>

namespace geodesic {

// For each position, the index of the first position that it is one with: the first equal one, or with a
// tolerance > 0 the first representative at most that far away. result[i] <= i, result[result[i]] ==
// result[i].
std::vector<uint32_t> weld(const std::vector<Eigen::Vector3d>& positions, double tolerance);

}
