#pragma once

#include "src/index/index.h"

namespace geodesic {

// Samples the rings and the outer tables: fills what index.overlay_tables has of them, anew if it has some.
void make_coarse_tables(Index& index);

}
