#pragma once

#include <cstdint>
#include <span>

#include "src/mesh/mesh.h"

namespace geodesic {

// Straightens the borders between cells. Voronoi cells of vertices meet in zigzags, which have almost twice
// as many border vertices as are needed. A face moves to another cell if more of its neighbours are in that
// cell than in its own, until there is no such face. A cell that is connected over edges stays connected, and
// no cell loses its last face. cell[i] is the cell of faces[i].
void straighten_borders(const Mesh& mesh, std::span<const uint32_t> faces, std::span<uint32_t> cell);

}
