#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/mesh/mesh.h"
#include "src/metric/metric.h"
#include "src/partition/random.h"

namespace geodesic {

// Splits a patch, given by its faces, into about `count` patches of faces, each connected and with at most
// one border ring.
std::vector<std::vector<uint32_t>> split_patch(const Mesh& mesh, std::span<const uint32_t> faces,
                                               uint32_t count, uint32_t lloyd_iterations, FieldSolver& solver,
                                               Random& random);

}
