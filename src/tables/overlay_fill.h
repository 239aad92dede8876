#pragma once

#include <optional>
#include <span>

#include "src/index/stored.h"
#include "src/mesh/mesh.h"
#include "src/metric/workers.h"
#include "src/tables/measured_tables.h"
#include "src/tables/near_distances.h"

namespace geodesic {

struct OverlayOptions {
    uint32_t exact_vertices; // patches with at most this many vertices inside are measured
    double rounding;         // see rounding_of_patches()
    bool unfold;             // paths may cross borders between vertices: the metric is locally Euclidean
    double stage_end;        // where the stage "closure" ends, see Workers::begin_stage()
};

// Fills the tables, quanta and segments of the overlay engine with distances on the whole surface. The layout
// must be stored already. The tables of leaves and of small patches hold the metric's own distances. Those of
// larger patches are put together from their children's tables, and then lowered by paths that leave the
// patch. Filling takes 4 bytes of memory for each table entry, and 4 more for each entry of one table at a
// time. vertex_of_number gives the mesh vertex of each number. Unless `near` is NULL, it takes all distances
// that it has room for. Unless `measured` is NULL, what it holds is not measured again, and then it takes
// what is measured for this mesh, which is another 4 bytes for each entry of a measured table.
void fill_overlay_tables(const Mesh& mesh, std::span<const uint32_t> leaf_of_face,
                         std::span<const uint32_t> vertex_of_number, const OverlayOptions& options,
                         Workers& workers, StoredIndex& stored, NearDistances* near,
                         std::optional<MeasuredTables>* measured);

}
