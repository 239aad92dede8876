#pragma once

#include <cstdint>

#include "src/overlay/tables.h"

namespace geodesic {

// The number of codes in the tables of all samples. Needs the rings of the index.
uint64_t count_sample_codes(const OverlayIndex& index);

// Whether the border of a patch is so long that it has a table across: its ring has more places than this.
constexpr uint32_t LONGEST_WITHOUT_TABLE_ACROSS = 128;
bool has_table_across(const OverlayIndex& index, uint32_t patch);

// Fills empty `samples` of an index that has its rings and outer tables.
void make_samples(const OverlayIndex& index, Samples& samples);

}
