#pragma once

#include <cstdint>

namespace geodesic::file_campaign {

// The most bytes, since the last call of start_peak(), that this program has held by operator new, as which
// all of the library's arrays are allocated, temporary ones too, unless the caller gives it an allocator.
uint64_t peak_memory();
void start_peak();

}
