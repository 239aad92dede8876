#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/mesh/mesh.h"

namespace geodesic {

// A mesh in which some edges of another mesh are cut in halves. It is the same surface, with the same
// distances: the faces beside such an edge are divided into two, three or four in their own planes.
struct HalvedEdges {
    // The vertices of the other mesh, with their numbers, and then the middles of the edges that were cut,
    // in the order of these.
    Mesh mesh;
    std::vector<uint32_t> whole_face; // per face of `mesh`: the face of the other mesh that it is a part of
};

// Cuts the given edges, each of which is there once.
HalvedEdges halve_edges(const Mesh& mesh, std::span<const uint32_t> edges);

}
