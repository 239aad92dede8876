#include "src/mesh/parts.h"

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

struct Part {
    Eigen::AlignedBox3d box;
    double edge_sum = 0;
    uint32_t edge_count = 0;

    uint8_t edges_across() const {
        constexpr double MOST = 255;
        const double average_edge = edge_sum / std::max(edge_count, 1u), diagonal = box.diagonal().norm();
        return static_cast<uint8_t>(diagonal < MOST * average_edge ? diagonal / average_edge : MOST);
    }
};

}

std::vector<uint8_t> edges_across_parts(const Mesh& mesh) {
    JoinedVertices joined(mesh.vertex_count());
    for (const auto& [a, b] : mesh.edges) joined.join(a, b);
    std::vector<Part> parts(mesh.vertex_count()); // of the least vertex of each
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v)
        parts[joined.least_of(v)].box.extend(mesh.positions[v]);
    for (uint32_t e = 0; e < mesh.edge_count(); ++e) {
        Part& part = parts[joined.least_of(mesh.edges[e][0])];
        part.edge_sum += mesh.edge_length(e);
        ++part.edge_count;
    }
    std::vector<uint8_t> across(mesh.vertex_count());
    for (uint32_t v = 0; v < across.size(); ++v) across[v] = parts[joined.least_of(v)].edges_across();
    return across;
}

}
