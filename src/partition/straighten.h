#pragma once

#include <cstdint>
#include <span>

#include "src/mesh/mesh.h"

namespace geodesic {

// Moves faces into cells that more of their neighbours are in than in their own, until there are none, so
// that fewer edges lie between cells: cells of nearest vertices meet in zigzags, with almost twice as many
// border vertices as are needed. Cells that hang together over edges go on to do so, and none loses its last
// face. `cell`: parallel to `faces`.
void straighten_borders(const Mesh& mesh, std::span<const uint32_t> faces, std::span<uint32_t> cell);

}
