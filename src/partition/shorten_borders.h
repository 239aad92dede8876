#pragma once

#include <cstdint>
#include <span>

#include "src/mesh/mesh.h"

namespace geodesic {

// Moves the borders between cells to where they have few and short edges. Voronoi cells of vertices meet in
// zigzags, which have almost twice as many vertices as are needed, and each one is a row and a column of
// tables. The cost of an edge is 1 plus the square of its length in average edges of the patch, in 64ths,
// since the error of paths that cross it between its ends grows with that square.
//
// Between any two cells the border becomes the cheapest one in a band around it, beyond which each cell stays
// as it is. So no cell loses its last face; but its faces need not be connected as they were.
//
// edge_lengths are those of all edges of the mesh. cell[i] is the cell of faces[i], or NONE: such faces stay
// as they are. Returns what all borders cost now: to be compared with other cells of the same faces only.
uint64_t shorten_borders(const Mesh& mesh, std::span<const double> edge_lengths,
                         std::span<const uint32_t> faces, std::span<uint32_t> cell);

}
