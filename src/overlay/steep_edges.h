#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "src/base/array.h"
#include "src/index/stored.h"

namespace geodesic {

// Edges of the mesh along which some field was seen to change by more than they are long: no exact distances
// do. Each says by how much the distances of its two ends may differ at most; FieldLowering lowers fields so
// that they do not differ by more.
struct SteepEdges {
    explicit SteepEdges(std::pmr::memory_resource* memory) : edges(memory), ends(memory), begin(memory) {}

    // In ascending order of their second ends: those are spread over all numbers, and most first ends are on
    // borders, which have the smallest ones, so that a field is read from its beginning to its end.
    Array<VertexPair> edges;
    // The same once for each end, block by block of sixteen numbers of vertices.
    struct End {
        uint32_t number, other;
        float most;
    };
    Array<End> ends;
    Array<uint32_t> begin; // per block, and the end of the last one; empty if there are no edges

    static uint32_t block_of(uint32_t number) { return number / 16; }
    // Those of a vertex, and of the others in its block.
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
