#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "src/base/array.h"
#include "src/index/stored.h"

namespace geodesic {

// The pairs of vertices whose distance an index holds besides its tables, because what the tables say of them
// was seen to be wrong. Each pair is there twice, once for each of its vertices.
struct MeasuredPairs {
    explicit MeasuredPairs(std::pmr::memory_resource* memory) : begin(memory), others(memory) {}

    struct Other {
        uint32_t number;
        float distance;
    };

    Array<uint32_t>
        begin;           // per vertex number: where its pairs begin in `others`; empty if there are no pairs
    Array<Other> others; // of each vertex in ascending order
    // Of what tables say of these pairs, relative to their distances, by the classes of these.
    std::array<float, DISTANCE_CLASSES> largest_errors{};

    std::span<const Other> of(uint32_t number) const {
        if (begin.empty()) return {};
        return {others.data() + begin[number], others.data() + begin[number + 1]};
    }

    // Those whose other vertex has a number in first .. end - 1. A point of a face, whose key follows the
    // numbers of all vertices, has none.
    std::span<const Other> of(uint32_t key, uint32_t first, uint32_t end) const;

    // The distance of a pair, NULL if it is not one of these.
    const float* distance(uint32_t first, uint32_t second) const;
};

// Replaces all pairs by these, which are in ascending order. The largest errors stay as they are.
void take_measured_pairs(std::span<const VertexPair> pairs, uint32_t vertex_count, MeasuredPairs& measured);

// The pairs that were taken.
std::vector<VertexPair> restore_measured_pairs(const MeasuredPairs& measured);

}
