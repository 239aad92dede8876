#include "src/partition/patch.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace geodesic {

std::vector<uint32_t> vertices_of(const Mesh& mesh, std::span<const uint32_t> faces) {
    std::vector<uint32_t> vertices;
    vertices.reserve(faces.size() * 3);
    for (uint32_t f : faces) vertices.insert(vertices.end(), mesh.faces[f].begin(), mesh.faces[f].end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

namespace {

class DisjointSets {
public:
    explicit DisjointSets(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

    uint32_t find(uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void unite(uint32_t a, uint32_t b) { parent_[find(a)] = find(b); }

private:
    std::vector<uint32_t> parent_;
};

struct BoundaryEdge {
    std::array<uint32_t, 2> vertices;
    bool shared; // another patch lies on the other side
};

std::vector<BoundaryEdge> boundary_edges(const Mesh& mesh, std::span<const uint32_t> faces,
                                         const std::vector<uint8_t>& inside) {
    std::vector<BoundaryEdge> result;
    for (uint32_t f : faces)
        for (uint32_t e : mesh.face_edges[f]) {
            const auto sides = mesh.edge_faces[e];
            const bool shared =
                std::any_of(sides.begin(), sides.end(), [&](uint32_t g) { return !inside[g]; });
            if (shared || sides.size() == 1) result.push_back({mesh.edges[e], shared});
        }
    return result;
}

}

uint32_t count_border_rings(const Mesh& mesh, std::span<const uint32_t> faces,
                            const std::vector<uint8_t>& inside) {
    const auto edges = boundary_edges(mesh, faces, inside);
    std::unordered_map<uint32_t, uint32_t> number;
    for (const auto& edge : edges)
        for (uint32_t v : edge.vertices) number.try_emplace(v, static_cast<uint32_t>(number.size()));
    DisjointSets chains(number.size());
    for (const auto& edge : edges) chains.unite(number[edge.vertices[0]], number[edge.vertices[1]]);
    std::vector<uint8_t> is_border(number.size(), 0);
    for (const auto& edge : edges)
        if (edge.shared) is_border[chains.find(number[edge.vertices[0]])] = 1;
    return static_cast<uint32_t>(std::count(is_border.begin(), is_border.end(), 1));
}

Components connected_components(const Mesh& mesh, std::span<const uint32_t> faces,
                                std::span<const uint32_t> label) {
    std::unordered_map<uint32_t, uint32_t> position;
    position.reserve(faces.size());
    for (uint32_t i = 0; i < faces.size(); ++i) position.emplace(faces[i], i);

    Components components;
    components.of_face.assign(faces.size(), NONE);
    std::vector<uint32_t> stack;
    for (uint32_t start = 0; start < faces.size(); ++start) {
        if (components.of_face[start] != NONE) continue;
        components.of_face[start] = components.count;
        stack.push_back(start);
        while (!stack.empty()) {
            const uint32_t i = stack.back();
            stack.pop_back();
            for (uint32_t e : mesh.face_edges[faces[i]])
                for (uint32_t g : mesh.edge_faces[e]) {
                    const auto found = position.find(g);
                    if (found == position.end()) continue;
                    const uint32_t j = found->second;
                    if (components.of_face[j] != NONE || label[j] != label[i]) continue;
                    components.of_face[j] = components.count;
                    stack.push_back(j);
                }
        }
        ++components.count;
    }
    return components;
}

}
