#pragma once

#include "src/overlay/tables.h"

namespace geodesic {

// Fills index.hops.inner_middles.
void make_middle_tables(OverlayIndex& index);

}
