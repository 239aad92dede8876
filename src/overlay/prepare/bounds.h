#pragma once

#include "src/overlay/tables/tables.h"

namespace geodesic {

// Fills InnerBounds from the inner tables and those of middles.
void make_inner_bounds(OverlayIndex& index);

// How many codes that makes; it needs the rings only.
uint64_t count_bound_codes(const OverlayIndex& index);

}
