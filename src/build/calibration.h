#pragma once

#include <span>

#include "src/build/relative_errors.h"
#include "src/index/stored.h"
#include "src/metric/workers.h"

namespace geodesic {

// Which sources calibrate() is given; they are not those of measure_error().
inline constexpr uint64_t CALIBRATION_SEED = 0x7363616C65;

// Where a path crosses a border between two vertices, its length is estimated, and it comes out too long by
// about the same share everywhere. Compares MSAD with the metric, and divides the distances of all overlay
// tables by 1 + the median of the signed relative errors, a tenth either way at most. The tables of leaves
// hold the metric's own distances and stay as they are. vertex_of_number gives the mesh vertex of each
// number.
void calibrate(const ExactFields& exact, std::span<const uint32_t> vertex_of_number, Workers& workers,
               StoredIndex& stored);

}
