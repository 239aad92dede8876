#pragma once

#include "src/overlay/tables.h"

namespace geodesic {

// Makes sure that an index has its labels. The first thread that asks makes them while others wait; when that
// throws, as where memory is short, the next one to ask begins anew.
void require_labels(const OverlayIndex& index);

}
