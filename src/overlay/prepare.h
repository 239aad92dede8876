#pragma once

#include "src/index/stored.h"
#include "src/overlay/tables.h"

namespace geodesic {

// Fills an empty index of the overlay engine from what is stored, except for its labels. Throws what
// number_vertices() throws, Error CORRUPT where a segment does not end where it may, and Error LIMIT where a
// border has too many vertices or the derived tables would be out of proportion.
void prepare_overlay(const StoredIndex& stored, OverlayIndex& index);

// Does the opposite: fills all fields of `stored` but the description and the ids.
void restore_overlay(const OverlayIndex& index, StoredIndex& stored);

}
