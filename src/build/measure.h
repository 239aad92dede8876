#pragma once

#include <span>

#include "src/build/relative_errors.h"
#include "src/metric/workers.h"
#include "src/query/index.h"

namespace geodesic {

// Which sources measure_error() is given.
inline constexpr uint64_t MEASURING_SEED = 0x6572726F72;

// Compares MSAD with the metric. vertex_of_number gives the mesh vertex of each number.
MeasuredError measure_error(const Index& index, const ExactFields& exact,
                            std::span<const uint32_t> vertex_of_number, Workers& workers);

}
