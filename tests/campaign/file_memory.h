#pragma once

#include <cstdint>

namespace geodesic::file_campaign {

// Bytes that this program holds by operator new, as which all of the library's arrays are allocated,
// temporary ones too, unless the caller gives it an allocator.
uint64_t memory_at_hand();

// The most since the last call of start_peak().
uint64_t peak_memory();
void start_peak();

}
