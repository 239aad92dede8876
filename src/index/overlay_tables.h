#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <vector>

#include "src/mesh/mesh.h"

namespace geodesic {

// What the overlay engine reads besides the hierarchy. Distances are codes: code * quantum of the patch.
struct OverlayTables {
    static constexpr uint16_t LARGEST = 0x7ffe; // so that two codes add up in 16 bits
    static constexpr uint16_t UNREACHED = 0x7fff;

    static constexpr size_t PADDING = 32; // entries at the end of `tables` and `crossing_tables`

    explicit OverlayTables(std::pmr::memory_resource* memory)
        : quantum(memory), table_begin(memory), tables(memory), crossing_tables(memory),
          internal_tables(memory), next(memory), previous(memory), segment_length(memory) {}

    std::pmr::vector<float> quantum;        // per patch
    std::pmr::vector<uint64_t> table_begin; // per inner patch
    // Overlay x overlay, whole, in overlay positions: the columns of the patch's border as one matrix, then
    // those of the vertices that it owns as another, so that each hop reads memory from end to end.
    std::pmr::vector<uint16_t> tables;
    std::pmr::vector<uint16_t> crossing_tables, internal_tables; // placed as those of Index

    // Border segments, where the metric unfolds: per slot the position in its patch's border of the vertex at
    // the other end of an edge along the border, or NONE. segment_length is that of the edge to `next`.
    std::pmr::vector<uint32_t> next, previous;
    std::pmr::vector<float> segment_length;

    // A border vertex and the two on each side of it, by their positions in the border, and the lengths of
    // the four segments between them. Where there is no segment the length is NaN, and beyond it the vertex
    // is the one before once more.
    struct Neighbourhood {
        uint32_t position[5];
        float length[4];
    };
    // first_slot: where the border's slots begin.
    Neighbourhood around(uint32_t first_slot, uint32_t position) const {
        constexpr float NOT = std::numeric_limits<float>::quiet_NaN();
        Neighbourhood near{{position, position, position, position, position}, {NOT, NOT, NOT, NOT}};
        for (int k = 2; k < 4; ++k) {
            const uint32_t slot = first_slot + near.position[k];
            near.position[k + 1] = next[slot] == NONE ? near.position[k] : next[slot];
            if (next[slot] != NONE) near.length[k] = segment_length[slot];
        }
        for (int k = 2; k > 0; --k) {
            const uint32_t before = previous[first_slot + near.position[k]];
            near.position[k - 1] = before == NONE ? near.position[k] : before;
            if (before != NONE) near.length[k - 1] = segment_length[first_slot + before];
        }
        return near;
    }
};

}
