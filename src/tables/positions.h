#pragma once

#include <cstdint>
#include <span>

#include "src/index/stored.h"
#include "src/mesh/mesh.h"

namespace geodesic {

// Fills POSI. Positions serve A* and the prediction of distances, which need no more than a small share of
// an edge.
void round_positions(const Mesh& mesh, std::span<const uint32_t> vertex_of_number, StoredIndex& stored);

}
