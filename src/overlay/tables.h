#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>

#include "src/base/array.h"
#include "src/index/numbering.h"
#include "src/overlay/codes.h"
#include "src/overlay/rings.h"

namespace geodesic {

// Codes of distances over one hop. Each patch has a row, one code a place of its ring, for everything that is
// one hop away from its border: in the outer table the overlay of its parent, by the parent's quantum; in the
// inner table, by its own, its inner vertices. A sweep down reads all inner tables, and beside them the codes
// of the middle of the segment that begins at a place.
struct HopTables {
    explicit HopTables(std::pmr::memory_resource* memory)
        : outer_begin(memory), inner_begin(memory), outer(memory), inner(memory), inner_middles(memory),
          internal(memory) {}

    Array<uint64_t> outer_begin, inner_begin; // per patch
    Array<uint16_t> outer, inner, inner_middles;
    Array<uint16_t> internal; // of leaves, below the diagonal: at Numbering::internal_entry()
};

// A sample of each ring, and of the outer tables, over which SSSD looks for ways first. The table of a patch
// has rows for the samples of its parent's ring and of its siblings' and its own, in this order; that of a
// ring whose vertices are all samples is not stored: its rows are in the outer table.
struct Samples {
    explicit Samples(std::pmr::memory_resource* memory)
        : rings(memory), full_place(memory), sample_of_place(memory), begin(memory), positions(memory),
          spacing(memory), longest_gap(memory), first_row(memory), row_begin(memory), row_position(memory),
          table_begin(memory), tables(memory) {}

    Rings rings;
    Array<uint32_t> full_place; // per place: the own place of its vertex among all, counted over all rings
    Array<uint32_t> sample_of_place; // per place: which of the border's samples it is
    Array<uint32_t> begin;           // per patch: of its samples in `positions`
    Array<uint32_t> positions;       // per sample: in the border
    Array<float> spacing;            // per patch: from a sample to the next one, on average
    Array<float> longest_gap;        // per patch: along the border, from a sample to the next one, at most
    Array<uint32_t> first_row;       // per patch: of its samples in the tables of its siblings
    Array<uint32_t> row_begin;       // per inner patch: of its children's rows in `row_position`
    Array<uint32_t> row_position;    // per row: its position in the overlay of the parent
    Array<uint64_t> table_begin;     // per patch
    Array<uint16_t> tables;

    std::span<const uint32_t> of(uint32_t patch) const {
        return {positions.data() + begin[patch], positions.data() + begin[patch + 1]};
    }
};

// The label of a vertex: its distances to the borders of the patches that it lies in beyond the first one
// (Numbering::entry()), from the outermost one inwards, without the whole mesh, in steps of the quantum of
// that patch's parent: the nearest one's, its low half and its high one, then how much longer each is
// (StepsOf), to all of a border that has at most WHOLE vertices, in its order, or to the samples of its ring.
struct Labels {
    explicit Labels(std::pmr::memory_resource* memory) : offset(memory), begin(memory), codes(memory) {}

    static constexpr uint32_t WHOLE = 400;
    static constexpr uint32_t HEAD = 2;

    Array<uint32_t> offset; // per patch: where its border begins in the labels of what lies deeper; where the
                            // labels of its inner vertices end
    Array<uint64_t> begin;  // per patch: of its inner vertices' labels
    Array<int16_t> codes;
};

// What the overlay engine answers from.
struct OverlayIndex {
    explicit OverlayIndex(std::pmr::memory_resource* memory)
        : numbering(memory), quantum(memory), rings(memory), longest_segment(memory), hops(memory),
          near(memory), samples(memory), labels(memory) {}

    Numbering numbering;
    Array<float> quantum; // per patch: the distance of one step of its codes
    BorderRings rings;
    Array<float> longest_segment; // per patch: of its ring; 0 without any
    HopTables hops;
    Array<float> near; // per patch: up to which distance a pair is answered over every segment of its border
    Samples samples;
    Labels labels; // none before make_labels()

    float distance(uint16_t code, uint32_t patch) const { return TableCode::distance(code, quantum[patch]); }

    // Where a row begins in the outer table of a patch: of a position in its parent's overlay; and in the
    // inner one.
    uint64_t outer_row(uint32_t patch, uint32_t overlay_position) const {
        return hops.outer_begin[patch] + uint64_t{overlay_position} * rings.size(patch);
    }
    uint64_t inner_row(uint32_t patch, uint32_t inner) const {
        return hops.inner_begin[patch] + uint64_t{inner} * rings.size(patch);
    }

    // An entry of the overlay table of an inner patch.
    uint16_t overlay_code(uint32_t patch, uint32_t i, uint32_t j) const {
        const uint32_t slot = numbering.slots_of(patch, j).front();
        return hops.outer[outer_row(numbering.patch_of_slot[slot], i) + rings.place_of_slot[slot]];
    }
    uint16_t border_internal_code(uint32_t leaf, uint32_t border_position, uint32_t internal) const {
        return hops.inner[inner_row(leaf, internal) +
                          rings.place_of_slot[numbering.border_begin[leaf] + border_position]];
    }
    uint16_t internal_code(uint32_t leaf, uint32_t i, uint32_t j) const {
        return hops.internal[numbering.internal_entry(leaf, i, j)];
    }

    // Distances in a label to the border of a patch.
    uint32_t label_size(uint32_t patch) const {
        const uint32_t size = numbering.border_size(patch);
        return size <= Labels::WHOLE ? size : static_cast<uint32_t>(samples.of(patch).size());
    }
    bool is_labelled_whole(uint32_t patch) const { return label_size(patch) == numbering.border_size(patch); }
};

}
