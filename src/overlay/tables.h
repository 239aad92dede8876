#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory_resource>
#include <mutex>
#include <optional>
#include <span>

#include "src/base/array.h"
#include "src/base/room.h"
#include "src/index/numbering.h"
#include "src/overlay/codes.h"
#include "src/overlay/rings.h"

namespace geodesic {

// The tables that hops read: codes of distances, in rows along a ring, with one code for each place of the
// ring. Every patch has two such tables. Its outer table has a row for each vertex of its parent's overlay
// that is not on its own border, in steps of the parent's quantum; hops up and across read it. Its inner
// table has a row for each of its own inner vertices, in steps of its own quantum; hops down read it. Beside
// each row of an inner table lies a row of inner_middles, which has, for each place, the distance to the
// middle of the segment that begins there.
//
// Two vertices that lie on the borders of the very same children of a patch are in no outer table together.
// One of these children keeps their distance: its kept table has all pairs of the vertices that it keeps,
// below the diagonal.
//
// All codes lie one table kind after the other, so that a mapped file can hold them as they are.
struct HopTables {
    explicit HopTables(std::pmr::memory_resource* memory)
        : outer_begin(memory), kept_begin(memory), inner_begin(memory), row_begin(memory), own_before(memory),
          kept_number(memory), made(memory) {}

    static constexpr uint16_t OWN = 0xffff;

    Array<uint64_t> outer_begin, kept_begin, inner_begin; // per patch
    Array<uint64_t> row_begin;                            // per patch: where its rows begin in own_before
    // Of patches with a border, per position of the parent's overlay: how many of those before it are on the
    // patch's own border, or OWN if it is itself. (A border has fewer vertices than a ring may have places.)
    Array<uint16_t> own_before;
    Array<uint16_t> kept_number;     // per slot whose patch keeps the vertex: its row in the kept table
    std::span<const uint16_t> codes; // those of the following five, in this order
    std::span<const uint16_t> outer, kept, inner, inner_middles;
    std::span<const uint16_t> internal; // of leaves, below the diagonal, at Numbering::internal_entry()
    Array<uint16_t> made;               // `codes`, unless they lie in a file
};

// For rows of inner tables along long borders: the least code of each block of PLACES places, those of the
// middles included. A sum of two codes in a block is at least the sum of the least ones, so that most blocks
// of a row need not be read. They follow from the other tables and are in no file.
struct InnerBounds {
    static constexpr size_t PLACES = 16;
    static constexpr size_t FEWEST_PLACES = 224; // shorter borders are read as a whole as quickly

    explicit InnerBounds(std::pmr::memory_resource* memory) : begin(memory), codes(memory) {}

    Array<uint64_t> begin; // per patch: where those of its rows begin in `codes`
    Array<uint16_t> codes;

    static size_t blocks(size_t places) { return (places + PLACES - 1) / PLACES; }
    static bool are_kept(size_t places) { return places >= FEWEST_PLACES; }
};

// The samples of all borders, and the distances between samples: SSSD looks for ways over these first. Each
// sample is given by its own place in the ring of its border. Samples are numbered border by border, along
// the ring, and have two kinds of tables, in steps of the quantum of the table that they are taken from.
// Kernels read their rows as far as whole blocks.
//
// Ways are straightened over the long segments of a border, those that are longer than samples are apart.
// Both ends of each are samples.
//
// Up: for each patch whose parent has a border, rows for the samples of the patch, each with one code for
// every sample of the parent. Across: for each patch whose border is long, rows for the samples of all
// children of its parent, in the order of their numbers, each with one code for every sample of the patch.
// Where a border is not long, hops across read the outer table of its patch. Two samples that lie on both
// borders have no path in these tables, since each has its distance without a hop; a sample and itself are at
// distance 0.
struct Samples {
    explicit Samples(std::pmr::memory_resource* memory)
        : begin(memory), place(memory), spacing(memory), long_begin(memory), long_segments(memory),
          up_begin(memory), across_begin(memory), codes(memory) {}

    struct LongSegment {
        uint32_t first, second; // samples, counted from the first one of the border
        float length;
    };

    Array<uint32_t> begin;      // per patch
    Array<uint16_t> place;      // per sample, counted from the first place of its ring
    Array<float> spacing;       // per patch: how far apart samples are to be, on average
    Array<uint32_t> long_begin; // per patch: where its long segments begin in `long_segments`
    Array<LongSegment> long_segments;
    Array<uint64_t> up_begin;     // per patch: where its table up begins in `codes`
    Array<uint64_t> across_begin; // per patch: where its table across begins in `codes`
    Array<uint16_t> codes;

    std::span<const uint16_t> of(uint32_t patch) const {
        return {place.data() + begin[patch], place.data() + begin[patch + 1]};
    }
    // The first row for the samples of a patch in the table across of a sibling, which must have one.
    const uint16_t* rows_across(const Numbering& numbering, uint32_t patch, uint32_t sibling) const {
        const uint32_t row = begin[patch] - begin[numbering.child_begin[numbering.parent[patch]]];
        return codes.data() + across_begin[sibling] + size_t{row} * of(sibling).size();
    }
    std::span<const LongSegment> long_segments_of(uint32_t patch) const {
        return {long_segments.data() + long_begin[patch], long_segments.data() + long_begin[patch + 1]};
    }
};

// The labels of vertices: rows as those of inner tables, of distances to the border of a patch farther out,
// in steps of a quantum of their own. Of the patches around a vertex, the outermost one whose border is
// neither empty nor long is labelled, if it is no leaf; vertices that lie deeper than its inner vertices have
// labels. Pairs of vertices that meet outside of labelled patches need not cross the borders inside.
//
// Labels are made patch by patch, each when a pair needs it (see require_labels): what belongs to a labelled
// patch may be read once are_made[patch] has been seen.
struct Labels {
    Labels(uint32_t patches, std::pmr::memory_resource* memory)
        : is_labelled(patches, uint8_t{0}, memory), begin(patches, 0, memory), quantum(patches, 0.f, memory),
          are_made(patches, std::pmr::polymorphic_allocator<>(memory)) {}

    Array<uint8_t> is_labelled;        // per patch
    Array<uint64_t> begin;             // per patch: where the labels of its inner vertices begin in `codes`
    Array<float> quantum;              // per patch; of labelled ones
    Array<std::atomic<bool>> are_made; // per patch; of labelled ones
    Room<uint16_t> codes;              // NULL if no patch is labelled
};

// What only pairs of vertices need. It is empty until require_pair_tables() makes it, when the first pair is
// asked for; labels follow one by one.
struct PairTables {
    explicit PairTables(std::pmr::memory_resource* memory) : samples(memory) {}

    bool has_labels = true; // or will have them
    Samples samples;
    std::optional<Labels> labels;
    std::mutex making; // held while one thread fills any of the arrays
    std::atomic<bool> are_made = false;
};

// The slot of a vertex of a patch's overlay on the border of the child that keeps it. It is the same child
// for all vertices that lie on the borders of the same children; different ones take turns.
inline uint32_t kept_slot(const Numbering& numbering, uint32_t patch, uint32_t overlay_position) {
    const auto slots = numbering.slots_of(patch, overlay_position);
    const uint32_t first = numbering.patch_of_slot[slots.front()],
                   last = numbering.patch_of_slot[slots.back()];
    return slots[(first + last) % slots.size()];
}

// Calls use(slot) with that slot for each vertex of each overlay, in the order of the overlays.
template <class Use>
void for_each_kept(const Numbering& numbering, const Use& use) {
    for (uint32_t p = 0; p < numbering.first_leaf(); ++p)
        for (uint32_t i = 0; i < numbering.overlay_size(p); ++i) use(kept_slot(numbering, p, i));
}

// The rows of the outer table of a patch.
struct OuterRows {
    const uint16_t* own_before; // NULL if the border of the patch is empty
    const uint16_t* codes;
    size_t places;

    // The row of a vertex, or NULL if the vertex is on the patch's own border, or if that is empty. The
    // vertex is given by its position in the overlay of the patch's parent.
    const uint16_t* of(uint32_t overlay_position) const {
        if (!own_before || own_before[overlay_position] == HopTables::OWN) return nullptr;
        return codes + size_t{overlay_position - own_before[overlay_position]} * places;
    }
};

// What the overlay engine answers from.
struct OverlayIndex {
    explicit OverlayIndex(std::pmr::memory_resource* memory)
        : numbering(memory), quantum(memory), shift(memory), rings(memory), longest_segment(memory),
          hops(memory), bounds(memory), pairs(memory) {}

    Numbering numbering;
    Array<float> quantum; // per patch: the distance of one step of its codes
    Array<uint8_t> shift; // per patch: its stored codes are multiples of 2^shift; only files need it
    Rings rings;
    Array<float> longest_segment; // per patch: length of the longest segment of its border, or 0
    HopTables hops;
    InnerBounds bounds;
    mutable PairTables pairs;

    float distance(uint16_t code, uint32_t patch) const { return TableCode::distance(code, quantum[patch]); }

    OuterRows outer_rows(uint32_t patch) const {
        const uint32_t places = rings.size(patch);
        return {places == 0 ? nullptr : hops.own_before.data() + hops.row_begin[patch],
                hops.outer.data() + hops.outer_begin[patch], places};
    }
    const uint16_t* outer_row(uint32_t patch, uint32_t overlay_position) const {
        return outer_rows(patch).of(overlay_position);
    }
    // Where a row begins in the inner table of a patch, which has one for each of its inner vertices.
    uint64_t inner_row(uint32_t patch, uint32_t inner) const {
        return hops.inner_begin[patch] + uint64_t{inner} * rings.size(patch);
    }

    // The entry for the overlay positions i and j in the overlay table of an inner patch.
    uint16_t overlay_code(uint32_t patch, uint32_t i, uint32_t j) const {
        if (i == j) return 0;
        if (const uint16_t* const code = outer_code(patch, i, j)) return *code;
        if (const uint16_t* const code = outer_code(patch, j, i)) return *code;
        const uint32_t slot = kept_slot(numbering, patch, i);
        const uint32_t a = hops.kept_number[slot], b = hops.kept_number[kept_slot(numbering, patch, j)];
        return hops.kept[hops.kept_begin[numbering.patch_of_slot[slot]] +
                         below_diagonal(std::max(a, b), std::min(a, b))];
    }
    uint16_t border_internal_code(uint32_t leaf, uint32_t border_position, uint32_t internal) const {
        return hops.inner[inner_row(leaf, internal) +
                          rings.place_of_slot[numbering.border_begin[leaf] + border_position]];
    }
    uint16_t internal_code(uint32_t leaf, uint32_t i, uint32_t j) const {
        return hops.internal[numbering.internal_entry(leaf, i, j)];
    }

private:
    // The entry in the row of the overlay position i of the outer table of a child that has j on its border,
    // or NULL if all these children have i there, too.
    const uint16_t* outer_code(uint32_t patch, uint32_t i, uint32_t j) const {
        for (const uint32_t slot : numbering.slots_of(patch, j))
            if (const uint16_t* const row = outer_row(numbering.patch_of_slot[slot], i))
                return row + rings.place_of_slot[slot];
        return nullptr;
    }
};

}
