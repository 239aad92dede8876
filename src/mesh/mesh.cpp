#include "src/mesh/mesh.h"

#include <algorithm>
#include <string>

#include "format/error.h"

namespace geodesic {

ListOfLists<uint32_t> group_by(std::span<const uint32_t> keys, uint32_t group_count) {
    ListOfLists<uint32_t> groups;
    groups.begin.assign(size_t{group_count} + 1, 0);
    for (uint32_t key : keys) ++groups.begin[key + 1];
    for (size_t i = 1; i < groups.begin.size(); ++i) groups.begin[i] += groups.begin[i - 1];
    groups.items.resize(keys.size());
    std::vector<uint32_t> next(groups.begin.begin(), groups.begin.end() - 1);
    for (size_t i = 0; i < keys.size(); ++i) groups.items[next[keys[i]]++] = static_cast<uint32_t>(i);
    return groups;
}

namespace {

struct HalfEdge {
    uint32_t low, high, face, opposite_corner;

    auto operator<=>(const HalfEdge&) const = default;
};

std::vector<HalfEdge> sorted_half_edges(const Mesh& mesh) {
    std::vector<HalfEdge> half_edges;
    half_edges.reserve(mesh.faces.size() * 3);
    for (uint32_t f = 0; f < mesh.face_count(); ++f)
        for (uint32_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(mesh.faces[f][(k + 1) % 3], mesh.faces[f][(k + 2) % 3]);
            half_edges.push_back({low, high, f, k});
        }
    std::sort(half_edges.begin(), half_edges.end());
    return half_edges;
}

}

void connect(Mesh& mesh) {
    mesh.edges.clear();
    mesh.edge_faces = {};
    mesh.face_edges.assign(mesh.faces.size(), {NONE, NONE, NONE});
    for (const HalfEdge& h : sorted_half_edges(mesh)) {
        if (mesh.edges.empty() || mesh.edges.back() != std::array{h.low, h.high}) {
            if (!mesh.edges.empty()) mesh.edge_faces.close_list();
            mesh.edges.push_back({h.low, h.high});
        }
        mesh.edge_faces.items.push_back(h.face);
        mesh.face_edges[h.face][h.opposite_corner] = mesh.edge_count() - 1;
    }
    if (!mesh.edges.empty()) mesh.edge_faces.close_list();
    if (mesh.edges.size() > MOST_EDGES)
        throw Error(GEOIDX_ERROR_LIMIT, "the mesh has more than " + std::to_string(MOST_EDGES) + " edges");

    std::vector<uint32_t> corner_vertices;
    corner_vertices.reserve(mesh.faces.size() * 3);
    for (const auto& face : mesh.faces)
        corner_vertices.insert(corner_vertices.end(), face.begin(), face.end());
    mesh.vertex_faces = group_by(corner_vertices, mesh.vertex_count());
    for (uint32_t& corner : mesh.vertex_faces.items) corner /= 3;
}

ListOfLists<uint32_t> edge_ends_at_vertices(const Mesh& mesh) {
    std::vector<uint32_t> ends;
    for (const auto& edge : mesh.edges) ends.insert(ends.end(), edge.begin(), edge.end());
    return group_by(ends, mesh.vertex_count());
}

std::vector<uint32_t> neighbours(const Mesh& mesh, uint32_t vertex) {
    std::vector<uint32_t> others;
    for (const uint32_t face : mesh.vertex_faces[vertex])
        for (const uint32_t corner : mesh.faces[face])
            if (corner != vertex) others.push_back(corner);
    std::ranges::sort(others);
    others.erase(std::unique(others.begin(), others.end()), others.end());
    return others;
}

uint64_t edge_key(uint32_t a, uint32_t b) { return uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

uint32_t find_edge(const Mesh& mesh, uint32_t a, uint32_t b) {
    const std::array<uint32_t, 2> wanted{std::min(a, b), std::max(a, b)};
    const auto found = std::lower_bound(mesh.edges.begin(), mesh.edges.end(), wanted);
    if (found == mesh.edges.end() || *found != wanted) return NONE;
    return static_cast<uint32_t>(found - mesh.edges.begin());
}

double mean_edge(const Mesh& mesh) {
    double sum = 0;
    for (uint32_t e = 0; e < mesh.edge_count(); ++e) sum += mesh.edge_length(e);
    return sum / mesh.edge_count();
}

}
