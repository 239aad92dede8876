#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/mesh/mesh.h"
#include "src/metric/metric.h"

namespace geodesic {

// Assigns each face of a patch to the Voronoi cell of a seed under the metric: to the cell that most of its
// vertices are in or, if all are in different ones, to that of the vertex nearest to its seed. result[i] is
// the cell of faces[i], or NONE if no seed can be reached from it.
std::vector<uint32_t> voronoi_cells(FieldSolver& solver, const Mesh& mesh, std::span<const uint32_t> faces,
                                    std::span<const uint32_t> seeds);

// Lloyd relaxation as in the paper's section 3.1: moves each seed to the vertex of its cell that is farthest
// from the cell's border. `cell` is what voronoi_cells() returned.
void relax_seeds(FieldSolver& solver, const Mesh& mesh, std::span<const uint32_t> faces,
                 std::span<const uint32_t> cell, std::span<uint32_t> seeds);

}
