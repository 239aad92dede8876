#pragma once

#include <span>

#include "src/index/border_segments.h"
#include "src/index/numbering.h"
#include "src/mesh/mesh.h"
#include "src/tables/distance_tables.h"

namespace geodesic {

// Finds the segments of all borders: vertices on a patch's border that are joined by an edge between that
// patch and others. The length of a segment is the distance of its ends in a table above the leaves.
BorderSegments find_segments(const Mesh& mesh, std::span<const uint32_t> leaf_of_face,
                             std::span<const uint32_t> vertex_of_number, const DistanceTables& tables,
                             const Numbering& numbering);

}
