#pragma once

#include <cstdint>
#include <vector>

#include "src/mesh/mesh.h"
#include "src/metric/workers.h"

namespace geodesic {

// The paper's section 3.3. Greedily merges adjacent border vertices that belong to the same set of leaves,
// the smallest error first, as long as the error stays within `largest_error` (a distance). The error of a
// merged group is the distance from the vertex that stands for it to its farthest member: a path that crossed
// at a member grows by at most twice that. Returns per vertex whether it stands for a group (its own, if
// nothing was merged into it); the other members of groups are no border vertices any more.
std::vector<uint8_t> merge_border_vertices(const Mesh& mesh, const ListOfLists<uint32_t>& leaves_at_vertex,
                                           double largest_error, Workers& workers);

}
