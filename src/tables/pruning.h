#pragma once

#include <cstdint>
#include <vector>

#include "src/mesh/mesh.h"
#include "src/metric/workers.h"

namespace geodesic {

// Merges border vertices (paper 3.3). It merges adjacent border vertices that belong to the same set of
// leaves, greedily, with the smallest error first, as long as the error is at most `largest_error` (a
// distance). The error of a merged group is the distance from the vertex that stands for the group to its
// farthest member: a path that crossed the border at a member grows by at most twice that. Returns for each
// vertex whether it stands for a group (for itself, if nothing was merged into it). The other members of a
// group are no border vertices any more.
std::vector<uint8_t> merge_border_vertices(const Mesh& mesh, const ListOfLists<uint32_t>& leaves_at_vertex,
                                           double largest_error, Workers& workers);

}
