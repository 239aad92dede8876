#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "src/base/array.h"
#include "src/index/stored.h"

namespace geodesic {

// Edges of the mesh along which some field was found to change by more than 1.049 times their length. (Exact
// distances change by no more than the length.) The `distance` of such a pair is its limit: by how much the
// distances of its two ends may differ. FieldLowering lowers fields so that they do not differ by more.
struct SteepEdges {
    explicit SteepEdges(std::pmr::memory_resource* memory) : edges(memory), ends(memory), begin(memory) {}

    // In ascending order of their second ends, so that a look at all of them reads a field from its beginning
    // to its end. (Most first ends are border vertices, which have the smallest numbers.)
    Array<VertexPair> edges;
    // Each edge twice, once for each of its ends, in blocks of sixteen consecutive numbers of vertices.
    struct End {
        uint32_t number, other;
        float limit;
    };
    Array<End> ends;
    Array<uint32_t> begin; // per block, and the end of the last one; empty if there are no edges

    static uint32_t block_of(uint32_t number) { return number / 16; }
    // All ends in the block of a vertex. Those of the vertex itself have its number.
    std::span<const End> in_block_of(uint32_t number) const {
        const uint32_t* const at = begin.data() + block_of(number);
        return {ends.data() + at[0], ends.data() + at[1]};
    }
};

// Replaces all edges by these, which are in ascending order.
void take_steep_edges(std::span<const VertexPair> edges, uint32_t vertex_count, SteepEdges& steep);

// The edges that were taken, in that order.
std::vector<VertexPair> restore_steep_edges(const SteepEdges& steep);

}
