#include "src/metric/metric.h"

#include "src/mesh/mesh.h"

namespace geodesic {

FieldSolver::FieldSolver(uint32_t vertex_count)
    : distance_(vertex_count, UNREACHABLE), nearest_(vertex_count, NONE) {}

void FieldSolver::solve(std::span<const uint32_t> sources, std::span<const uint32_t> targets, double radius) {
    for (uint32_t vertex : touched_) {
        distance_[vertex] = UNREACHABLE;
        nearest_[vertex] = NONE;
    }
    touched_.clear();
    run(sources, targets, radius);
}

}
