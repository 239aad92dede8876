#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/mesh/mesh.h"
#include "src/metric/metric.h"

namespace geodesic {

// Assigns each face of a patch to the Voronoi cell of a seed under the metric: the cell of most of its
// vertices, or of the vertex nearest to a seed. Parallel to `faces`; NONE where no seed can be reached.
std::vector<uint32_t> voronoi_cells(FieldSolver& solver, const Mesh& mesh, std::span<const uint32_t> faces,
                                    std::span<const uint32_t> seeds);

// Lloyd relaxation as in the paper's section 3.1: moves each seed to the vertex of its cell that is farthest
// from the cell's border. `cell` as from voronoi_cells.
void relax_seeds(FieldSolver& solver, const Mesh& mesh, std::span<const uint32_t> faces,
                 std::span<const uint32_t> cell, std::span<uint32_t> seeds);

}
