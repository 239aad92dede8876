#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "src/base/numbers.h"

namespace geodesic {

// Lists of different lengths in one array: list i is items[begin[i]] .. items[begin[i + 1] - 1].
template <class T>
struct ListOfLists {
    std::vector<uint32_t> begin{0};
    std::vector<T> items;

    std::span<const T> operator[](size_t i) const {
        return {items.data() + begin[i], items.data() + begin[i + 1]};
    }
    std::span<T> operator[](size_t i) { return {items.data() + begin[i], items.data() + begin[i + 1]}; }
    size_t size() const { return begin.size() - 1; }
    void close_list() { begin.push_back(static_cast<uint32_t>(items.size())); }
};

// Groups the numbers 0 .. keys.size() - 1 by their key, keeping their order within a group.
ListOfLists<uint32_t> group_by(std::span<const uint32_t> keys, uint32_t group_count);

// A clean triangle mesh: every vertex is used, no face is degenerate or there twice.
struct Mesh {
    std::vector<Eigen::Vector3d> positions;
    std::vector<std::array<uint32_t, 3>> faces;
    std::vector<std::array<uint32_t, 3>> face_edges; // face_edges[f][k] is opposite to faces[f][k]
    std::vector<std::array<uint32_t, 2>> edges;      // the smaller vertex first
    ListOfLists<uint32_t> edge_faces;
    ListOfLists<uint32_t> vertex_faces;

    uint32_t vertex_count() const { return static_cast<uint32_t>(positions.size()); }
    uint32_t face_count() const { return static_cast<uint32_t>(faces.size()); }
    uint32_t edge_count() const { return static_cast<uint32_t>(edges.size()); }
    double edge_length(uint32_t e) const { return (positions[edges[e][0]] - positions[edges[e][1]]).norm(); }
};

// So many edges a mesh may have: both ends of all of them are counted in 32 bits.
inline constexpr size_t MOST_EDGES = UINT32_MAX / 2;

// Derives edges and incidences from positions and faces, whose ids are in range. Edges are in ascending
// order. Error LIMIT: there are more than MOST_EDGES.
void connect(Mesh& mesh);

// Per vertex the ends of edges there: 2 edge + 0 or 1, as in `edges`.
ListOfLists<uint32_t> edge_ends_at_vertices(const Mesh& mesh);

// The other corners of the faces around a vertex, each once, in ascending order.
std::vector<uint32_t> neighbours(const Mesh& mesh, uint32_t vertex);

// The mean length of all edges.
double mean_edge(const Mesh& mesh);

// What tells an edge from others, whichever of its vertices comes first.
uint64_t edge_key(uint32_t a, uint32_t b);

// The edge between two vertices, or NONE.
uint32_t find_edge(const Mesh& mesh, uint32_t a, uint32_t b);

}
