#include "src/path/edge_search.h"

#include <algorithm>
#include <utility>

#include "src/base/number_map.h"
#include "src/path/open_nodes.h"

namespace geodesic {

namespace {

class EdgeSearch {
public:
    EdgeSearch(const Surface& surface, std::span<const VertexEnd> targets,
               const std::function<double(uint32_t)>& distance_to_target,
               const std::function<double(uint32_t, uint32_t)>& edge_length)
        : surface_(surface), targets_(targets), distance_to_target_(distance_to_target),
          edge_length_(edge_length) {}

    std::optional<std::vector<uint32_t>> run(std::span<const VertexEnd> sources);

private:
    struct Node {
        uint32_t vertex; // NONE: the target
        double length;
        uint32_t before;
    };

    void reach(uint32_t vertex, double length, uint32_t before);
    void leave(uint32_t index);
    std::vector<uint32_t> vertices_to(uint32_t index) const;

    const Surface& surface_;
    std::span<const VertexEnd> targets_;
    const std::function<double(uint32_t)>& distance_to_target_;
    const std::function<double(uint32_t, uint32_t)>& edge_length_;
    OpenNodes<Node> open_;
    NumberMap<bool> is_closed_;
    std::vector<uint32_t> neighbours_;
};

void EdgeSearch::reach(uint32_t vertex, double length, uint32_t before) {
    const double rest = length < UNREACHABLE ? distance_to_target_(vertex) : UNREACHABLE;
    if (rest < UNREACHABLE) open_.push(length + rest, {vertex, length, before});
}

void EdgeSearch::leave(uint32_t index) {
    const Node node = open_[index];
    const auto target = std::ranges::find(targets_, node.vertex, &VertexEnd::vertex);
    if (target != targets_.end()) {
        const double length = node.length + target->distance;
        open_.push(length, {NONE, length, index});
    }
    neighbours_.clear();
    for (const uint32_t face : surface_.vertex_faces[node.vertex])
        for (const uint32_t other : surface_.faces[face])
            if (other != node.vertex && !is_closed_[other]) neighbours_.push_back(other);
    std::ranges::sort(neighbours_);
    neighbours_.erase(std::unique(neighbours_.begin(), neighbours_.end()), neighbours_.end());
    for (const uint32_t other : neighbours_)
        reach(other, node.length + edge_length_(node.vertex, other), index);
}

std::vector<uint32_t> EdgeSearch::vertices_to(uint32_t index) const {
    std::vector<uint32_t> vertices;
    for (uint32_t i = open_[index].before; i != NONE; i = open_[i].before)
        vertices.push_back(open_[i].vertex);
    std::ranges::reverse(vertices);
    return vertices;
}

std::optional<std::vector<uint32_t>> EdgeSearch::run(std::span<const VertexEnd> sources) {
    for (const auto& [vertex, distance] : sources) reach(vertex, distance, NONE);
    while (!open_.empty()) {
        const uint32_t index = open_.pop();
        if (open_[index].vertex == NONE) return vertices_to(index);
        if (!std::exchange(is_closed_[open_[index].vertex], true)) leave(index);
    }
    return std::nullopt;
}

}

std::optional<std::vector<uint32_t>>
search_edges(const Surface& surface, std::span<const VertexEnd> sources, std::span<const VertexEnd> targets,
             const std::function<double(uint32_t)>& distance_to_target,
             const std::function<double(uint32_t, uint32_t)>& edge_length) {
    return EdgeSearch(surface, targets, distance_to_target, edge_length).run(sources);
}

}
