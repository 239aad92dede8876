#pragma once

#include <span>

#include "src/index/numbering.h"
#include "src/metric/metric.h"
#include "src/tables/near_distances.h"

namespace geodesic {

// The distance that the latest solve found for a vertex of the mesh. Throws Error LIMIT if it is too large
// for a float.
float measured_distance(const FieldSolver& solver, uint32_t vertex);

// Solves from one vertex for these targets and, unless `near` is NULL, for what is near.
void solve_for_tables(uint32_t vertex, std::span<const uint32_t> targets, const NearDistances* near,
                      FieldSolver& solver);

// Measures the distances of an internal vertex to the border of its leaf and to the leaf's internal vertices
// with larger numbers, and writes them into tables that are laid out as in StoredIndex. vertex_of_number
// gives the mesh vertex of each number. Unless `near` is NULL, what is near is solved for, too. Returns
// whether there was anything to measure; if not, nothing has been solved.
bool measure_internal(const Numbering& numbering, std::span<const uint32_t> vertex_of_number, uint32_t number,
                      const NearDistances* near, FieldSolver& solver, std::span<float> border_internal_tables,
                      std::span<float> internal_tables);

}
