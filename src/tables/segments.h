#pragma once

#include <span>

#include "src/index/numbering.h"
#include "src/mesh/mesh.h"
#include "src/overlay/rings.h"
#include "src/tables/distance_tables.h"

namespace geodesic {

// Which neighbours on a patch's border an edge joins that lies between the patch and others, and how long it
// is by the tables above the leaves.
BorderSegments find_segments(const Mesh& mesh, std::span<const uint32_t> leaf_of_face,
                             std::span<const uint32_t> vertex_of_number, const DistanceTables& tables,
                             const Numbering& numbering);

}
