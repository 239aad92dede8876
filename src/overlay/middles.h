#pragma once

#include "src/overlay/tables.h"

namespace geodesic {

// Fills index.hops.inner_middles from the inner tables and the rings.
void make_middle_tables(OverlayIndex& index);

}
