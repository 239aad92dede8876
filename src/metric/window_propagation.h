#pragma once

#include <memory>

#include "src/metric/intrinsic_mesh.h"
#include "src/metric/metric.h"
#include "src/metric/window.h"

namespace geodesic {

// A solver that keeps the windows of its latest solve.
class WindowSolver : public FieldSolver {
public:
    using FieldSolver::FieldSolver;

    // Those on an edge, sorted along it and without overlaps, valid until the next solve. All that a shortest
    // path to a target of the latest solve can come over are there; others may be missing.
    virtual std::span<const Window> windows(uint32_t edge) const = 0;
};

// The exact polyhedral geodesic distance. A continuous Dijkstra over windows (Mitchell, Mount, Papadimitriou
// 1987; Surazhsky et al. 2005) that propagates all pending windows of an edge at once and drops early what a
// vertex already beats (Xin and Wang 2009). With a tolerance, windows are joined where that changes their
// distances by no more than this share: where triangles are long, an edge then has up to a hundred times
// fewer. Distances of vertices are off by about the tolerance on average, and by up to a hundred times as
// much anywhere, up or down (docs/figures.md, "With a tolerance").
class ExactMetric final : public Metric {
public:
    // own_lengths as in IntrinsicMesh.
    explicit ExactMetric(const Mesh& mesh, double tolerance = 0, std::span<const double> own_lengths = {})
        : mesh_(std::make_shared<IntrinsicMesh>(mesh, own_lengths)), tolerance_(tolerance) {}
    std::unique_ptr<FieldSolver> make_solver() const override;
    bool takes_points() const override { return true; }
    std::unique_ptr<WindowSolver> make_window_solver() const;
    const IntrinsicMesh& mesh() const { return *mesh_; }

private:
    std::shared_ptr<const IntrinsicMesh> mesh_;
    double tolerance_;
};

}
