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

// The vertices of edges between a patch, given by its faces, and others, each once, along these edges: ring
// by ring, from its smallest vertex to the smaller of its neighbours, or from one end to the other, where a
// ring is broken by the boundary of the mesh, or by another ring that touches it and was walked before.
// `inside[f]` tells whether face f is in the patch.
std::vector<std::vector<uint32_t>> walk_border(const Mesh& mesh, std::span<const uint32_t> faces,
                                               const std::vector<uint8_t>& inside);

}
