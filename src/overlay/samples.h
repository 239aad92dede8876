#pragma once

#include <span>

#include "src/overlay/tables.h"

namespace geodesic {

// The number of samples of a patch's border, and the number of places of the ring that they make.
struct SampleCount {
    uint32_t samples = 0, places = 0;
};

// Needs the rings of the index. make_samples() makes exactly as many.
SampleCount count_samples(const OverlayIndex& index, uint32_t patch);

// The number of codes in the coarse tables of a patch's children, by the samples of all patches.
uint64_t count_coarse_codes(const OverlayIndex& index, std::span<const SampleCount> samples, uint32_t parent);

// Fills empty `samples` of an index that has its rings and outer tables.
void make_samples(const OverlayIndex& index, Samples& samples);

}
