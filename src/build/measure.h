#pragma once

#include <span>

#include "src/metric/workers.h"
#include "src/query/index.h"

namespace geodesic {

// Compares MSAD with the metric for some seeded random sources, others than calibrate() has, and all
// vertices. vertex_of_number: the mesh vertex of each number.
MeasuredError measure_error(const Index& index, std::span<const uint32_t> vertex_of_number, Workers& workers);

}
