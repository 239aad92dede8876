#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/overlay/tables/tables.h"

namespace geodesic {

// Fills HopTables::inner_middles from the inner tables, the internal tables of leaves and the rings.
void make_middle_tables(const OverlayIndex& index, std::span<int8_t> middles);

// The strides of MiddleOffset of a patch's ring, of so many places.
void measure_middle_strides(const OverlayIndex& index, uint32_t patch, std::vector<int16_t>& strides);

}
