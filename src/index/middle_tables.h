#pragma once

#include "src/index/index.h"

namespace geodesic {

// Fills index.overlay_tables.inner_middles.
void make_middle_tables(Index& index);

}
