#pragma once

#include <cstdint>

namespace geodesic {

// How many threads a caller means by a number: 0 is one per processor. Throws Error INVALID_ARGUMENT for more
// than 1024.
uint32_t thread_count(uint32_t asked_for);

}
