#pragma once

#include "src/overlay/tables/tables.h"

namespace geodesic {

// Makes sure that an index has what pairs of vertices need, but for the labels themselves, which are made as
// pairs need them. The first thread that asks makes it while others wait; when that throws, as where memory
// is short, the next one to ask begins anew.
void require_pair_tables(const OverlayIndex& index);

// Frees them again. The next thread that asks makes them anew. No query may be running, and no Query that has
// answered a pair may be used again.
void release_pair_tables(const OverlayIndex& index);

}
