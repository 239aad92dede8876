#pragma once

#include <atomic>
#include <cstdint>
#include <memory_resource>
#include <mutex>
#include <span>

#include "src/base/array.h"
#include "src/index/numbering.h"
#include "src/overlay/codes.h"
#include "src/overlay/rings.h"

namespace geodesic {

// The tables that hops read: codes of distances, in rows along a ring, with one code for each place of the
// ring. Every patch has two such tables. Its outer table has a row for each vertex of its parent's overlay,
// in steps of the parent's quantum; hops up and across read it. Its inner table has a row for each of its own
// inner vertices, in steps of its own quantum; hops down read it. Beside each row of an inner table lies a
// row of inner_middles, which has, for each place, the distance to the middle of the segment that begins
// there. All codes lie one table kind after the other, so that a mapped file can hold them as they are.
struct HopTables {
    explicit HopTables(std::pmr::memory_resource* memory)
        : outer_begin(memory), inner_begin(memory), made(memory) {}

    Array<uint64_t> outer_begin, inner_begin; // per patch
    std::span<const uint16_t> codes;          // those of the following four, in this order
    std::span<const uint16_t> outer, inner, inner_middles;
    std::span<const uint16_t> internal; // of leaves, below the diagonal, at Numbering::internal_entry()
    Array<uint16_t> made;               // `codes`, unless they lie in a file
};

// The samples of all rings, and of the outer tables the rows and columns that belong to samples. SSSD looks
// for ways over these first. The coarse table of a patch has a column for each place of its ring of samples,
// and rows for the samples of its parent's ring and then of the rings of all its parent's children, itself
// included, in the order of their numbers. Where all vertices of a ring are samples, no coarse table is
// stored, because its rows are those of the outer table.
struct Samples {
    explicit Samples(std::pmr::memory_resource* memory)
        : rings(memory), full_place(memory), sample_of_place(memory), begin(memory), positions(memory),
          spacing(memory), shortest_told(memory), longest_gap(memory), first_row(memory), row_begin(memory),
          row_position(memory), table_begin(memory), tables(memory) {}

    Rings rings;
    // Per place: the own place of its vertex in OverlayIndex::rings, counted over all rings.
    Array<uint32_t> full_place;
    Array<uint32_t> sample_of_place; // per place: the number of its sample on the border
    Array<uint32_t> begin;           // per patch: where its samples begin in `positions`
    Array<uint32_t> positions;       // per sample: its position in the border
    Array<float> spacing;            // per patch: the mean distance between neighbouring samples
    // Per patch: where shorter ways cross the border, samples do not tell.
    Array<float> shortest_told;
    Array<float> longest_gap;  // per patch: the longest way along the border between neighbouring samples
    Array<uint32_t> first_row; // per patch: the first row of its samples in its own and its siblings' tables
    Array<uint32_t> row_begin; // per inner patch: where its children's rows begin in `row_position`
    Array<uint32_t> row_position; // per row: its position in the overlay of the parent
    Array<uint64_t> table_begin;  // per patch
    Array<uint16_t> tables;

    std::span<const uint32_t> of(uint32_t patch) const {
        return {positions.data() + begin[patch], positions.data() + begin[patch + 1]};
    }
};

// The labels of all vertices. The label of a vertex holds its distances to the borders of all patches that
// contain it, but for the whole mesh, for the patch that it is an inner vertex of
// (Numbering::innermost_patch()), and for parents of leaves, which are one hop away; the outermost patch
// comes first. For each border, in steps of the quantum of the patch's parent, it has HEAD numbers, which are
// the low and the high half of the distance of the nearest vertex, a float, and then a code for each labelled
// vertex that says by how many steps it is farther (see StepsOf). All vertices of a border are labelled, in
// its order, if it has at most WHOLE of them; otherwise its samples are.
struct Labels {
    explicit Labels(std::pmr::memory_resource* memory) : offset(memory), begin(memory), codes(memory) {}

    static constexpr uint32_t WHOLE = 400;
    static constexpr uint32_t HEAD = 2;

    Array<uint32_t> offset; // per patch: where its border begins in the labels of deeper vertices, which is
                            // also how long the labels of its inner vertices are
    Array<uint64_t> begin;  // per patch: where the labels of its inner vertices begin in `codes`
    Array<int16_t> codes;
};

// What only pairs of vertices need. It takes more memory than all other tables, so that it is empty until
// require_pair_tables() makes it, when the first pair is asked for.
struct PairTables {
    explicit PairTables(std::pmr::memory_resource* memory) : samples(memory), labels(memory) {}

    Samples samples;
    Labels labels;
    std::mutex making; // held while one thread fills the arrays
    std::atomic<bool> are_made = false;
};

// What the overlay engine answers from.
struct OverlayIndex {
    explicit OverlayIndex(std::pmr::memory_resource* memory)
        : numbering(memory), quantum(memory), shift(memory), rings(memory), longest_segment(memory),
          hops(memory), pairs(memory) {}

    Numbering numbering;
    Array<float> quantum; // per patch: the distance of one step of its codes
    Array<uint8_t> shift; // per patch: its stored codes are multiples of 2^shift; only files need it
    BorderRings rings;
    Array<float> longest_segment; // per patch: length of the longest segment of its border, or 0
    HopTables hops;
    mutable PairTables pairs;

    float distance(uint16_t code, uint32_t patch) const { return TableCode::distance(code, quantum[patch]); }

    // Where a row begins in the outer table of a patch, which has a row for each position in its parent's
    // overlay, and in its inner table, which has one for each of its inner vertices.
    uint64_t outer_row(uint32_t patch, uint32_t overlay_position) const {
        return hops.outer_begin[patch] + uint64_t{overlay_position} * rings.size(patch);
    }
    uint64_t inner_row(uint32_t patch, uint32_t inner) const {
        return hops.inner_begin[patch] + uint64_t{inner} * rings.size(patch);
    }

    // The entry for the overlay positions i and j in the overlay table of an inner patch.
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

    // Whether labels hold distances to the border of a patch.
    bool is_labelled(uint32_t patch) const {
        return patch > 0 && patch < numbering.level_begin[numbering.level_count() - 1];
    }
    // How many distances to the border of a labelled patch a label holds.
    uint32_t label_size(uint32_t patch) const {
        const uint32_t size = numbering.border_size(patch);
        return size <= Labels::WHOLE ? size : static_cast<uint32_t>(pairs.samples.of(patch).size());
    }
    bool is_labelled_whole(uint32_t patch) const {
        return is_labelled(patch) && label_size(patch) == numbering.border_size(patch);
    }
};

}
