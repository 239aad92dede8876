#pragma once

#include "src/index/stored.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// Fills an empty index of the overlay engine from what is stored, except for what only pairs need. The hop
// codes of a mapped file stay where they are, and must outlive the index. Throws what
// number_vertices() throws, Error CORRUPT where a segment does not end where it may, and Error LIMIT where a
// border has too many vertices or the derived tables would be out of proportion.
void prepare_overlay(const StoredIndex& stored, OverlayIndex& index);

// Does the opposite: fills all fields of `stored` but the description and the ids. The hop codes are those of
// the index, and are valid as long as it is.
void restore_overlay(const OverlayIndex& index, StoredIndex& stored);

}
