#pragma once

#include "src/overlay/tables/pairs_of_vertices.h"

namespace geodesic {

// Edges of the mesh along which some field was found to change by more than 1.049 times their length. (Exact
// distances change by no more than the length.) The `distance` of such a pair is its limit: by how much the
// distances of its two ends may differ. FieldLowering lowers fields so that they do not differ by more.
struct SteepEdges : PairsOfVertices {
    explicit SteepEdges(std::pmr::memory_resource* memory) : PairsOfVertices(memory), edges(memory) {}

    // All of them, in ascending order of their second ends, so that a look at all reads a field from its
    // beginning to its end. (Most first ends are border vertices, which have the smallest numbers.)
    Array<VertexPair> edges;
};

// Replaces all edges by these, which are in ascending order.
void take_steep_edges(std::span<const VertexPair> edges, uint32_t vertex_count, SteepEdges& steep);

}
