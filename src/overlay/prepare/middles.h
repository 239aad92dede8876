#pragma once

#include <cstdint>
#include <span>

#include "src/overlay/tables/tables.h"

namespace geodesic {

// Fills MiddleStrides from the rings.
void measure_middle_strides(OverlayIndex& index);

// Fills HopTables::inner_middles from the inner tables, the internal tables of leaves, the rings and the
// strides.
void make_middle_tables(const OverlayIndex& index, std::span<uint8_t> middles);

}
