#pragma once

#include <cstdint>
#include <vector>

#include "src/mesh/mesh.h"

namespace geodesic {

// A *part* of a mesh is what its edges join. Of each vertex, how many average edges of its part the part is
// across, which is the diagonal of its bounding box: in whole ones, at most 255.
std::vector<uint8_t> edges_across_parts(const Mesh& mesh);

// Whether the edges of a part that is so many across are long for what its surface does.
inline bool are_long_edges(uint32_t edges_across) { return edges_across < 48; }

}
