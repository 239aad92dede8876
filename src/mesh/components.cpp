#include "src/mesh/components.h"

#include <algorithm>
#include <numeric>

#include <Eigen/Geometry>

namespace geodesic {

namespace {

// Vertices in sets that are joined; each set is told by its least vertex.
class JoinedVertices {
public:
    explicit JoinedVertices(uint32_t count) : before_(count) {
        std::iota(before_.begin(), before_.end(), 0u);
    }

    uint32_t least_of(uint32_t vertex) {
        while (before_[vertex] != vertex) vertex = before_[vertex] = before_[before_[vertex]];
        return vertex;
    }
    void join(uint32_t a, uint32_t b) {
        const auto [first, second] = std::minmax({least_of(a), least_of(b)});
        before_[second] = first;
    }

private:
    std::vector<uint32_t> before_; // per vertex: one that is no greater, and itself only of the least one
};

}

Components components_of(const Mesh& mesh) {
    JoinedVertices joined(mesh.vertex_count());
    for (const auto& [a, b] : mesh.edges) joined.join(a, b);
    Components components;
    components.of_vertex.resize(mesh.vertex_count());
    std::vector<Eigen::AlignedBox3d> boxes;
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        const uint32_t least = joined.least_of(v);
        if (least == v) boxes.emplace_back();
        components.of_vertex[v] =
            least == v ? static_cast<uint32_t>(boxes.size() - 1) : components.of_vertex[least];
        boxes[components.of_vertex[v]].extend(mesh.positions[v]);
    }
    std::vector<uint32_t> edge_counts(boxes.size());
    components.all.resize(boxes.size());
    for (uint32_t e = 0; e < mesh.edge_count(); ++e) {
        const uint32_t component = components.of_vertex[mesh.edges[e][0]];
        components.all[component].average_edge += mesh.edge_length(e);
        ++edge_counts[component];
    }
    for (size_t i = 0; i < boxes.size(); ++i) {
        components.all[i].diagonal = boxes[i].diagonal().norm();
        components.all[i].average_edge /= std::max(edge_counts[i], 1u);
    }
    return components;
}

}
