#pragma once

#include <span>

#include "src/index/numbering.h"
#include "src/metric/metric.h"

namespace geodesic {

// The distance of a vertex of the mesh in the latest solve; throws Error LIMIT where no float holds it.
float measured_distance(const FieldSolver& solver, uint32_t vertex);

// Measures an internal vertex against the border of its leaf and the internal vertices with larger numbers,
// and writes the distances to their places in tables laid out as StoredIndex has them. vertex_of_number: the
// mesh vertex of each number.
void measure_internal(const Numbering& numbering, std::span<const uint32_t> vertex_of_number, uint32_t number,
                      FieldSolver& solver, std::span<float> border_internal_tables,
                      std::span<float> internal_tables);

}
