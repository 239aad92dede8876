#pragma once

#include "src/index/numbering.h"
#include "src/index/slots.h"

namespace geodesic {

// What the graph engine answers from: the paper's tables of distances on the whole surface.
struct GraphIndex {
    explicit GraphIndex(std::pmr::memory_resource* memory)
        : numbering(memory), slots(memory), border_table_begin(memory), border_tables(memory),
          border_internal_tables(memory), internal_tables(memory) {}

    Numbering numbering;
    Slots slots;
    float bound_scale = 0;               // of the description
    Array<uint64_t> border_table_begin;  // per patch
    Array<float> border_tables;          // Bv x Bv, full, rows and columns in border order
    Array<float> border_internal_tables; // per leaf: Bv x Iv, a row per border vertex
    Array<float> internal_tables;        // per leaf: Iv x Iv below the diagonal, row by row

    const float* border_row(uint32_t patch, uint32_t position) const {
        return border_tables.data() + border_table_begin[patch] +
               uint64_t{position} * numbering.border_size(patch);
    }
    const float* border_internal_row(uint32_t leaf, uint32_t position) const {
        return border_internal_tables.data() + numbering.border_internal_entry(leaf, position, 0);
    }
    // Distance of two internal vertices of a leaf, given by their positions in it.
    float internal_distance(uint32_t leaf, uint32_t i, uint32_t j) const {
        return i == j ? 0 : internal_tables[numbering.internal_entry(leaf, i, j)];
    }
};

}
