#pragma once

#include <memory>
#include <span>

#include "src/metric/intrinsic_mesh.h"
#include "src/metric/metric.h"

namespace geodesic {

// A surface that costs more to cross in some faces than in others: the length of a path in a face counts
// `face_cost` times, along an edge as in the cheapest face there. Approximated by shortest paths in a graph
// (Lanthier, Maheshwari, Sack 1997): evenly spaced Steiner points on every edge, joined straight through
// every face.
//
// A distance is never below the true one. It is above it by at most the sum, over the pieces that the faces
// cut the true path into, of the piece's cost times half of the spacing on the edge at each of its ends.
class WeightedMetric final : public Metric {
public:
    // face_cost per face, positive and finite; own_lengths as in IntrinsicMesh. Throws Error LIMIT where
    // there are too many points.
    WeightedMetric(const Mesh& mesh, std::span<const double> face_cost, uint32_t points_per_edge,
                   std::span<const double> own_lengths = {});
    std::unique_ptr<FieldSolver> make_solver() const override;
    bool takes_points() const override { return true; }

    struct Graph {
        IntrinsicMesh mesh;
        std::vector<double> face_cost;
        std::vector<double> edge_cost; // of going along it
        uint32_t points_per_edge;
    };

private:
    std::shared_ptr<const Graph> graph_;
};

}
