#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace geodesic {

// For each position, the index of the first position that it is one with: the first equal one, or with a
// tolerance > 0 the first representative at most that far away. result[i] <= i, result[result[i]] ==
// result[i].
std::vector<uint32_t> weld(const std::vector<Eigen::Vector3d>& positions, double tolerance);

// Makes one position of those that the edges of triangles join which are no longer than `length`, too.
// `representative` is as weld() has it, and stays so.
void join_short_edges(const std::vector<Eigen::Vector3d>& positions,
                      std::span<const std::array<uint32_t, 3>> triangles, double length,
                      std::vector<uint32_t>& representative);

}
