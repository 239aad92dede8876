#pragma once

#include "src/index/slots.h"
#include "src/metric/workers.h"
#include "src/overlay/tables/rings.h"
#include "src/tables/distance_tables.h"

namespace geodesic {

// Puts the overlay table of a patch together from the tables of its children, which must be filled: patches
// with larger numbers come first. Entries are shortest paths over the children's borders, straightened where
// they cross a border between two vertices. Rows are shared out to the workers. Throws what Workers::run()
// throws.
void close_from_below(uint32_t patch, const Numbering& numbering, const Slots& slots, const Rings& rings,
                      Workers& workers, DistanceTables& tables);

// Lowers the overlay table of a patch, which is not the whole mesh, by paths that leave the patch and come
// back. The parent's table must have its final distances: patches with smaller numbers come first. Takes a
// second table of the same size meanwhile. Throws what Workers::run() throws.
void close_from_above(uint32_t patch, const Numbering& numbering, const Rings& rings, Workers& workers,
                      DistanceTables& tables);

}
