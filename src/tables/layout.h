#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/index/stored.h"
#include "src/mesh/mesh.h"
#include "src/metric/workers.h"
#include "src/partition/hierarchy.h"

namespace geodesic {

// Numbers the vertices as Numbering describes, so that neighbouring rows and columns of tables mostly belong
// to neighbours on the surface, and fills the sections HIER, VERT, POSI and BORD. `is_border[v]` is read for
// vertices where several leaves meet, and is false where pruning took the vertex off the border. Returns the
// mesh vertex of each number. `vertex_of_id` is that of Intake; vertices that no id has are numbered like
// others.
std::vector<uint32_t> lay_out(const Mesh& mesh, std::span<const uint32_t> vertex_of_id,
                              const Hierarchy& hierarchy, const ListOfLists<uint32_t>& leaves_at_vertex,
                              const std::vector<uint8_t>& is_border, Workers& workers, StoredIndex& stored);

}
