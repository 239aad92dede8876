#pragma once

#include "src/overlay/tables/tables.h"

namespace geodesic {

// How many bytes the hop tables of an index should have for each of its vertices, at most. Scans of up to
// 400,000 vertices have fewer with each distance in two rows.
constexpr uint64_t MOST_HOP_BYTES_EACH = 560;

// Fills is_large: the largest overlays, as few as are needed for that. Those of one size are large together.
// The index needs its rings.
void choose_large_overlays(OverlayIndex& index);

}
