#pragma once

#include "src/index/index.h"

namespace geodesic {

// Of a patch's ring: its samples, and the places of the coarse ring that they make.
struct SampleCount {
    uint32_t samples = 0, places = 0;
};

// Once the rings are laid out; make_coarse_tables() makes as many.
SampleCount count_samples(const Index& index, uint32_t patch);

// Samples the rings and the outer tables: fills what index.overlay_tables has of them, anew if it has some.
void make_coarse_tables(Index& index);

}
