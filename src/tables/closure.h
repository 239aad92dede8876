#pragma once

#include "src/metric/workers.h"
#include "src/overlay/rings.h"
#include "src/tables/distance_tables.h"

namespace geodesic {

// Puts the overlay table of a patch together from its children's: shortest paths over their borders,
// straightened where they cross one between two vertices.
void close_from_below(uint32_t patch, const Numbering& numbering, const BorderRings& rings, Workers& workers,
                      DistanceTables& tables);

// Lowers the overlay table of a patch by paths that leave it, which the parent's table knows.
void close_from_above(uint32_t patch, const Numbering& numbering, const BorderRings& rings, Workers& workers,
                      DistanceTables& tables);

}
