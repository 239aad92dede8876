#pragma once

#include <span>

#include "src/metric/workers.h"
#include "src/query/index.h"

namespace geodesic {

// Compares MSAD with the metric, from some seeded random sources to all vertices. The sources are not those
// of calibrate(). vertex_of_number gives the mesh vertex of each number.
MeasuredError measure_error(const Index& index, std::span<const uint32_t> vertex_of_number, Workers& workers);

}
