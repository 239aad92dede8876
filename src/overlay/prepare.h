#pragma once

#include "src/index/stored.h"
#include "src/overlay/tables.h"

namespace geodesic {

// Fills an empty index of the overlay engine, all but its labels, from what is stored. Throws as
// number_vertices() does, Error CORRUPT where a segment joins other positions than it may, and Error LIMIT
// where a border has too many vertices.
void prepare_overlay(const StoredIndex& stored, OverlayIndex& index);

// The opposite: fills all of `stored` but the description and the ids.
void restore_overlay(const OverlayIndex& index, StoredIndex& stored);

}
