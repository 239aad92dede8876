#pragma once

#include <span>

#include "src/index/stored.h"
#include "src/mesh/mesh.h"
#include "src/metric/workers.h"

namespace geodesic {

struct OverlayOptions {
    uint32_t exact_vertices; // patches of up to this many have overlay tables of the metric's own distances
    bool unfold;             // the metric is locally Euclidean: paths may cross borders between vertices
    double stage_end;        // of the stage of putting together, as Workers::begin_stage()
};

// Fills what the overlay engine stores besides the layout with distances on the whole surface: the tables of
// small patches and leaves are the metric's, those of larger ones are put together from their children's, and
// then shortened by paths that leave the patch. It takes 4 bytes a table entry, and 4 more an entry of one
// table at a time. vertex_of_number: the mesh vertex of each number.
void fill_overlay_tables(const Mesh& mesh, std::span<const uint32_t> leaf_of_face,
                         std::span<const uint32_t> vertex_of_number, const OverlayOptions& options,
                         Workers& workers, StoredIndex& stored);

}
