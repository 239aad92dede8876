#pragma once

#include "src/overlay/tables/tables.h"

namespace geodesic {

// Fills the codes of HopTables::inner_middles from the inner tables, the internal tables of leaves and the
// rings.
void make_middle_tables(const OverlayIndex& index, std::span<uint16_t> middles);

}
