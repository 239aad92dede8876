#pragma once

#include <cstdint>

#include "bench/table.h"

namespace geodesic::bench {

// Processor, compiler, library, and how busy the machine is.
Row machine_description();

// Gives freed memory back and makes peak_memory() begin anew (Linux).
void forget_peak_memory();

// The most memory that the process has held, in bytes; 0 where the system does not tell.
uint64_t peak_memory();

// What malloc has given and has not got back, in bytes; 0 where the system does not tell.
uint64_t heap_memory();

}
