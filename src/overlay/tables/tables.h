#pragma once

#include <cstdint>
#include <memory_resource>

#include "src/base/array.h"
#include "src/index/numbering.h"
#include "src/overlay/tables/codes.h"
#include "src/overlay/tables/half_table.h"
#include "src/overlay/tables/hop_tables.h"
#include "src/overlay/tables/measured_pairs.h"
#include "src/overlay/tables/rings.h"
#include "src/overlay/tables/samples_and_labels.h"
#include "src/overlay/tables/steep_edges.h"

namespace geodesic {

// What the overlay engine answers from.
struct OverlayIndex {
    explicit OverlayIndex(std::pmr::memory_resource* memory)
        : numbering(memory), quantum(memory), shift(memory), rings(memory), longest_segment(memory),
          is_large(memory), hops(memory), strides(memory), bounds(memory), measured(memory), steep(memory),
          pairs(memory) {}

    Numbering numbering;
    Array<float> quantum; // per patch: the distance of one step of its codes
    Array<uint8_t> shift; // per patch: its stored codes are multiples of 2^shift; only files need it
    Rings rings;
    Array<float> longest_segment; // per patch: length of the longest segment of its border, or 0
    Array<uint8_t> is_large;      // per inner patch: whether its owned table has each distance once
    HopTables hops;
    MiddleStrides strides;
    InnerBounds bounds;
    MeasuredPairs measured; // answers of all queries from vertices, unless a field is lowered
    SteepEdges steep;       // along which fields are lowered
    mutable PairTables pairs;

    float distance(uint16_t code, uint32_t patch) const { return TableCode::distance(code, quantum[patch]); }

    // The codes in the border table and in the owned table of an inner patch.
    uint64_t border_table_size(uint32_t patch) const {
        return uint64_t{rings.size(patch)} * numbering.border_size(patch);
    }
    uint64_t owned_table_size(uint32_t patch) const {
        const uint32_t owned = numbering.inner_size(patch);
        return is_large[patch] ? HalfTable::size(owned) : uint64_t{owned} * numbering.overlay_size(patch);
    }

    // The bytes of a patch in all hop tables but the internal one.
    uint64_t hop_table_bytes(uint32_t patch) const {
        const uint64_t inner = uint64_t{numbering.inner_size(patch)} * rings.size(patch);
        const uint64_t inner_and_middles = (sizeof(uint16_t) + sizeof(uint8_t)) * inner;
        if (patch >= numbering.first_leaf()) return inner_and_middles;
        return inner_and_middles + sizeof(uint16_t) * (border_table_size(patch) + owned_table_size(patch));
    }

    // Where a row begins in the inner table of a patch, which has one for each of its inner vertices.
    uint64_t inner_row(uint32_t patch, uint32_t inner) const {
        return hops.inner_begin[patch] + uint64_t{inner} * rings.size(patch);
    }

    // The rows of the vertex at a position of an inner patch's overlay: to the places of the patch's ring,
    // and to the vertices that it owns, unless the overlay is large.
    const uint16_t* row_to_ring(uint32_t patch, uint32_t position) const {
        const uint32_t border = numbering.border_size(patch);
        if (position >= border) return hops.inner.data() + inner_row(patch, position - border);
        return hops.border.data() + hops.border_begin[patch] + uint64_t{position} * rings.size(patch);
    }
    const uint16_t* row_to_owned(uint32_t patch, uint32_t position) const {
        return hops.owned.data() + hops.owned_begin[patch] + uint64_t{position} * numbering.inner_size(patch);
    }
    OverlayColumn overlay_column(uint32_t patch, uint32_t position) const {
        const uint32_t border = numbering.border_size(patch);
        if (position >= border) return {true, position - border};
        return {false, rings.place_of_slot[numbering.border_begin[patch] + position]};
    }
    // The entry for the overlay positions i and j.
    uint16_t overlay_code(uint32_t patch, uint32_t i, uint32_t j) const {
        return overlay_code(patch, i, overlay_column(patch, j));
    }
    uint16_t overlay_code(uint32_t patch, uint32_t i, const OverlayColumn& column) const {
        if (!column.is_owned) return row_to_ring(patch, i)[column.number];
        if (!is_large[patch]) return row_to_owned(patch, i)[column.number];
        const OverlayColumn from = overlay_column(patch, i);
        if (!from.is_owned) return hops.inner[inner_row(patch, column.number) + from.number];
        return hops.owned[hops.owned_begin[patch] + HalfTable::entry(from.number, column.number)];
    }

    // Whether the vertex at a position of the overlay of a patch's parent is on the patch's own border.
    bool is_on_border(uint32_t patch, uint32_t parent_position) const {
        const uint64_t flag = hops.on_border_begin[patch] + parent_position;
        return (hops.on_border[flag / 8] >> flag % 8 & 1) != 0;
    }
    // Where the vertex at a place of a patch's ring, counted over all rings, is in the parent's overlay.
    uint32_t position_in_parent(uint32_t patch, size_t place) const {
        return numbering.positions_in_parent(patch)[rings.position[place]];
    }

    uint16_t border_internal_code(uint32_t leaf, uint32_t border_position, uint32_t internal) const {
        return hops.inner[inner_row(leaf, internal) +
                          rings.place_of_slot[numbering.border_begin[leaf] + border_position]];
    }
    uint16_t internal_code(uint32_t leaf, uint32_t i, uint32_t j) const {
        return hops.internal[numbering.internal_entry(leaf, i, j)];
    }
};

}
