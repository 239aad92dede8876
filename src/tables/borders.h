#pragma once

#include <cstdint>
#include <vector>

#include "src/mesh/mesh.h"
#include "src/partition/hierarchy.h"

namespace geodesic {

// Which leaves meet at each vertex, ascending. More than one: a border vertex.
ListOfLists<uint32_t> leaves_at_vertices(const Mesh& mesh, const Hierarchy& hierarchy);

// The patch on whose children's borders a vertex first appears: the deepest one that contains all the given
// leaves.
uint32_t common_ancestor(const Hierarchy& hierarchy, std::span<const uint32_t> leaves);

// The vertices on the boundary of a patch, given by its faces, each once: ring by ring, from its smallest
// vertex to the smaller of its neighbours; where rings touch, a walk through one may take a part of another,
// and what is left of that is a walk from its one end to its other. `inside[f]` tells whether face f is in
// the patch.
std::vector<std::vector<uint32_t>> walk_boundary(const Mesh& mesh, std::span<const uint32_t> faces,
                                                 const std::vector<uint8_t>& inside);

}
