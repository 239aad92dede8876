#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "src/base/array.h"
#include "src/index/stored.h"

namespace geodesic {

// Pairs of vertices, arranged by vertex: each pair is there twice, once for each of its vertices.
struct PairsOfVertices {
    explicit PairsOfVertices(std::pmr::memory_resource* memory) : begin(memory), others(memory) {}

    struct Other {
        uint32_t number;
        float distance;
    };

    Array<uint32_t>
        begin;           // per vertex number: where its pairs begin in `others`; empty if there are no pairs
    Array<Other> others; // of each vertex in ascending order

    std::span<const Other> of(uint32_t number) const {
        if (begin.empty()) return {};
        return {others.data() + begin[number], others.data() + begin[number + 1]};
    }
};

// Replaces all pairs by these, which are in ascending order.
void take_pairs(std::span<const VertexPair> pairs, uint32_t vertex_count, PairsOfVertices& taken);

// The pairs that were taken, in ascending order.
std::vector<VertexPair> restore_pairs(const PairsOfVertices& taken);

}
