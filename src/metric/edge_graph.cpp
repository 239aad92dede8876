#include "src/metric/edge_graph.h"

#include "src/metric/vertex_front.h"

namespace geodesic {

namespace {

class Dijkstra final : public VertexFront {
public:
    explicit Dijkstra(std::shared_ptr<const ListOfLists<EdgeGraphMetric::Arc>> arcs)
        : VertexFront(static_cast<uint32_t>(arcs->size())), arcs_(std::move(arcs)) {}

private:
    void leave(uint32_t vertex) override {
        for (const auto& arc : (*arcs_)[vertex]) reach(arc.to, distance(vertex) + arc.cost, nearest(vertex));
    }

    std::shared_ptr<const ListOfLists<EdgeGraphMetric::Arc>> arcs_;
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
