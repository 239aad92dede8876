#include "src/metric/metric.h"

#include "format/error.h"
#include "src/mesh/mesh.h"

namespace geodesic {

void throw_cancelled() { throw Error(GEOIDX_ERROR_CANCELLED, "the progress callback cancelled the build"); }

FieldSolver::FieldSolver(uint32_t vertex_count)
    : distance_(vertex_count, UNREACHABLE), nearest_(vertex_count, NONE) {}

void FieldSolver::solve(const FieldRequest& request) {
    check_cancelled();
    forget(request);
    run(request);
}

void FieldSolver::forget(const FieldRequest& request) {
    for (uint32_t vertex : touched_) {
        distance_[vertex] = UNREACHABLE;
        nearest_[vertex] = NONE;
    }
    touched_.clear();
    point_distance_.assign(request.target_points.size(), UNREACHABLE);
    final_up_to_ = 0;
}

}
