#pragma once

#include <cstdint>
#include <vector>

#include "src/mesh/mesh.h"
#include "src/partition/hierarchy.h"

namespace geodesic {

// The leaves that meet at each vertex, in ascending order. A vertex with more than one leaf is a border
// vertex.
ListOfLists<uint32_t> leaves_at_vertices(const Mesh& mesh, const Hierarchy& hierarchy);

// The deepest patch that contains all the given leaves. A vertex at which these meet first appears on the
// borders of that patch's children.
uint32_t common_ancestor(const Hierarchy& hierarchy, std::span<const uint32_t> leaves);

// The vertices of all edges between a patch, given by its faces, and other patches. Each vertex comes once,
// and the vertices follow these edges walk by walk. A closed walk goes from its smallest vertex to the
// smaller of that vertex's neighbours. An open one goes from one end to the other: the boundary of the mesh
// breaks a walk, and so does one that touches it and came before. `inside[f]` tells whether face f is in the
// patch.
std::vector<std::vector<uint32_t>> walk_border(const Mesh& mesh, std::span<const uint32_t> faces,
                                               const std::vector<uint8_t>& inside);

}
