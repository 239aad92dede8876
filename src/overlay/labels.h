#pragma once

#include <cstdint>

#include "src/overlay/tables.h"

namespace geodesic {

// The number of codes in all labels. Needs the rings of the index.
uint64_t count_label_codes(const OverlayIndex& index);

// Fills empty `labels`, of which there are none where `with_labels` is false.
void make_labels(const OverlayIndex& index, bool with_labels, Labels& labels);

}
