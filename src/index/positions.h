#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "src/index/stored.h"

namespace geodesic {

// A position in whole steps from the origin, by the step and the origin of `stored`, and no farther than
// MOST_STEPS. Of the same position it is the same on every machine: all operations are exactly rounded, and
// there is no product that a compiler could fuse with a sum. So the builder's positions can be worked out
// again from the mesh, where a file leaves them out.
std::array<int32_t, 3> in_steps(const Eigen::Vector3d& position, const StoredIndex& stored);

}
