#pragma once

#include <span>

#include "bench/lossless_tables.h"

namespace geodesic::bench {

// How many bytes tables take in codings that the library does not write, for comparison.

// The distances of all tables, one after the other, as float32 in one zstd frame of level 19.
uint64_t bytes_as_float_zstd(std::span<const CodeTable> tables);

// The codes of each table as a gray PNG of 16 bits a pixel. All have the Paeth filter: of the filters, and of
// a choice of one for each row, it left the fewest bytes of all tables of armadillo together.
uint64_t bytes_as_gray_png(std::span<const CodeTable> tables);

}
