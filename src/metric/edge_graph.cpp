#include "src/metric/edge_graph.h"

#include "src/metric/event_queue.h"

namespace geodesic {

namespace {

class Dijkstra final : public FieldSolver {
public:
    Dijkstra(std::shared_ptr<const ListOfLists<EdgeGraphMetric::Arc>> arcs)
        : FieldSolver(static_cast<uint32_t>(arcs->size())), arcs_(std::move(arcs)), pending_(vertex_count()) {
    }

private:
    void run(const FieldRequest& request) override {
        queue_.clear();
        pending_.begin(request);
        for (uint32_t i = 0; i < request.sources.size(); ++i) reach(request.sources[i], 0, i);
        while (!queue_.empty()) {
            const auto event = queue_.pop();
            if (event.distance > request.radius) break;
            if (event.distance != distance(event.item)) continue;
            if (pending_.settle(event.item)) break;
            for (const auto& arc : (*arcs_)[event.item])
                reach(arc.to, event.distance + arc.cost, nearest(event.item));
        }
    }

    void reach(uint32_t vertex, double distance, uint32_t nearest) {
        if (improve(vertex, distance, nearest)) queue_.push(distance, vertex);
    }

    std::shared_ptr<const ListOfLists<EdgeGraphMetric::Arc>> arcs_;
    EventQueue queue_;
    PendingTargets pending_;
};

}

EdgeGraphMetric::EdgeGraphMetric(const Mesh& mesh, std::span<const double> cost) {
    const auto by_vertex = edge_ends_at_vertices(mesh);
    auto arcs = std::make_shared<ListOfLists<Arc>>();
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        for (uint32_t end : by_vertex[v])
            arcs->items.push_back({cost[end / 2], mesh.edges[end / 2][1 - end % 2]});
        arcs->close_list();
    }
    arcs_ = std::move(arcs);
}

std::unique_ptr<FieldSolver> EdgeGraphMetric::make_solver() const {
    return std::make_unique<Dijkstra>(arcs_);
}

std::vector<double> edge_lengths(const Mesh& mesh) {
    std::vector<double> lengths(mesh.edges.size());
    for (uint32_t e = 0; e < mesh.edge_count(); ++e) lengths[e] = mesh.edge_length(e);
    return lengths;
}

}
