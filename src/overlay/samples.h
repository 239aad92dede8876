#pragma once

#include "src/overlay/tables.h"

namespace geodesic {

// Of a patch's ring: its samples, and the places of the ring that they make.
struct SampleCount {
    uint32_t samples = 0, places = 0;
};

// Once the rings are laid out; make_samples() makes as many.
SampleCount count_samples(const OverlayIndex& index, uint32_t patch);

// Fills the samples of an index, and what is near, once its rings and outer tables are there.
void make_samples(OverlayIndex& index);

}
