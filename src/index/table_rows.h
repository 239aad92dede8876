#pragma once

#include "src/index/index.h"

namespace geodesic {

// Fills `count` rows for the ring of a patch, end to end, with code(row, position of the border).
template <class Code>
void fill_rows(const Index& index, uint32_t patch, uint32_t count, const Code& code, uint16_t* rows) {
    const uint32_t* ring =
        index.overlay_tables.rings.position.data() + index.overlay_tables.rings.begin[patch];
    const uint32_t places = index.ring_size(patch);
    for (uint32_t row = 0; row < count; ++row)
        for (uint32_t k = 0; k < places; ++k) *rows++ = code(row, ring[k]);
}

// The outer table of a patch: code(i, j) of positions in its parent's overlay.
template <class Code>
void fill_outer_table(Index& index, uint32_t patch, const Code& code) {
    const uint32_t* overlay_position = index.overlay_position.data() + index.border_begin[patch];
    fill_rows(
        index, patch, index.overlay_size(index.parent[patch]),
        [&](uint32_t i, uint32_t position) { return code(i, overlay_position[position]); },
        index.overlay_tables.outer_tables.data() + index.outer_row(patch, 0));
}

// The inner table of a patch: code(i, j) of the i-th inner vertex and position j of the border.
template <class Code>
void fill_inner_table(Index& index, uint32_t patch, const Code& code) {
    fill_rows(index, patch, index.inner_size(patch), code,
              index.overlay_tables.inner_tables.data() + index.inner_row(patch, 0));
}

}
