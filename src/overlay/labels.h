#pragma once

#include "src/overlay/tables.h"

namespace geodesic {

// Fills `labels`, of an index that has its samples.
void make_labels(const OverlayIndex& index, Labels& labels);

}
