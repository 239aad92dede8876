#include "src/tables/measuring.h"

#include <cfloat>
#include <string>

#include "format/error.h"
#include "src/base/number_text.h"

namespace geodesic {

float measured_distance(const FieldSolver& solver, uint32_t vertex) {
    const double distance = solver.distance(vertex);
    if (distance > double{FLT_MAX} && distance < UNREACHABLE)
        throw Error(GEOIDX_ERROR_LIMIT, "the metric gives the distance " + number_text(distance) +
                                            ", too large for a 32-bit float");
    return static_cast<float>(distance);
}

void solve_for_tables(uint32_t vertex, std::span<const uint32_t> targets, const NearDistances* near,
                      FieldSolver& solver) {
    if (near)
        solver.solve(near->with_near(vertex, targets));
    else
        solver.solve({&vertex, 1}, targets);
}

bool measure_internal(const Numbering& numbering, std::span<const uint32_t> vertex_of_number, uint32_t number,
                      const NearDistances* near, FieldSolver& solver, std::span<float> border_internal_tables,
                      std::span<float> internal_tables) {
    const uint32_t leaf = numbering.leaf_of(number), first = numbering.first_internal(leaf);
    const uint32_t own = number - first, size = numbering.internal_size(leaf);
    const auto border = numbering.border_of(leaf);
    std::vector<uint32_t> targets;
    for (uint32_t other : border) targets.push_back(vertex_of_number[other]);
    for (uint32_t i = own + 1; i < size; ++i) targets.push_back(vertex_of_number[first + i]);
    if (targets.empty()) return false;
    solve_for_tables(vertex_of_number[number], targets, near, solver);
    for (uint32_t i = 0; i < border.size(); ++i)
        border_internal_tables[numbering.border_internal_entry(leaf, i, own)] =
            measured_distance(solver, vertex_of_number[border[i]]);
    for (uint32_t i = own + 1; i < size; ++i)
        internal_tables[numbering.internal_entry(leaf, i, own)] =
            measured_distance(solver, vertex_of_number[first + i]);
    return true;
}

}
