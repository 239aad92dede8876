#pragma once

#include <span>

#include "src/index/index.h"
#include "src/mesh/mesh.h"
#include "src/tables/distance_tables.h"

namespace geodesic {

// Fills next, previous and segment_length of index.overlay_tables: which neighbours on a border an edge of
// the mesh joins, and how long it is by the tables above the leaves. With `unfold` false there are none.
void find_segments(const Mesh& mesh, std::span<const uint32_t> vertex_of_number, bool unfold,
                   const DistanceTables& tables, Index& index);

}
