#pragma once

#include <memory>
#include <span>

#include "src/mesh/mesh.h"
#include "src/metric/metric.h"

namespace geodesic {

// Shortest paths along the edges of the mesh (Dijkstra).
class EdgeGraphMetric final : public Metric {
public:
    // cost[e] of every edge of the mesh, finite and not negative.
    EdgeGraphMetric(const Mesh& mesh, std::span<const double> cost);
    std::unique_ptr<FieldSolver> make_solver() const override;

    struct Arc {
        double cost;
        uint32_t to;
    };

private:
    std::shared_ptr<const ListOfLists<Arc>> arcs_; // per vertex
};

// The length of every edge.
std::vector<double> edge_lengths(const Mesh& mesh);

}
