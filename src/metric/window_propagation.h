#pragma once

#include <memory>

#include "src/metric/intrinsic_mesh.h"
#include "src/metric/metric.h"

namespace geodesic {

// The exact polyhedral geodesic distance. A continuous Dijkstra over windows (Mitchell, Mount, Papadimitriou
// 1987; Surazhsky et al. 2005) that propagates all pending windows of an edge at once and drops early what a
// vertex already beats (Xin and Wang 2009).
class ExactMetric final : public Metric {
public:
    // own_lengths as in IntrinsicMesh.
    explicit ExactMetric(const Mesh& mesh, std::span<const double> own_lengths = {})
        : mesh_(std::make_shared<IntrinsicMesh>(mesh, own_lengths)) {}
    std::unique_ptr<FieldSolver> make_solver() const override;
    bool takes_points() const override { return true; }

private:
    std::shared_ptr<const IntrinsicMesh> mesh_;
};

}
