#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <mutex>
#include <optional>
#include <span>

#include "src/base/array.h"
#include "src/base/room.h"
#include "src/index/numbering.h"
#include "src/overlay/tables/codes.h"
#include "src/overlay/tables/half_table.h"
#include "src/overlay/tables/measured_pairs.h"
#include "src/overlay/tables/rings.h"
#include "src/overlay/tables/steep_edges.h"

namespace geodesic {

// The tables that hops read: codes of distances, in steps of the quantum of their patch. Those of two
// vertices on the patch's border are stored in steps of the parent's, and are converted.
//
// Each distance of an inner patch's overlay table lies there twice, in a row of both vertices. A row is in
// two parts: one code for each place of the patch's own ring, and one for each vertex that the patch owns.
// Rows to the ring are those of the border table, for the vertices on the patch's border, and those of the
// inner table, for the vertices that it owns. Rows to owned vertices are those of the owned table, for all
// vertices of the overlay. So a hop up or across reads the rows of a child's border, in which all that it
// leads to lies side by side.
//
// The owned table of a large overlay has each distance once. It is a HalfTable among the owned vertices, and
// rows from the border to these are the columns of the inner table. Hops turn what is missing into rows (see
// TurnedRows).
//
// A leaf has an inner table only, with a row for each of its internal vertices. Hops down read inner tables.
// Beside each row of one lies a row of inner_middles, which has, for each place, the MiddleOffset of the
// segment that begins there.
//
// All codes lie one table kind after the other, so that a mapped file can hold them as they are.
struct HopTables {
    explicit HopTables(std::pmr::memory_resource* memory)
        : border_begin(memory), owned_begin(memory), inner_begin(memory), on_border_begin(memory),
          on_border(memory), made(memory) {}

    Array<uint64_t> border_begin, owned_begin; // per inner patch; leaves have none
    Array<uint64_t> inner_begin;               // per patch
    Array<uint64_t> on_border_begin;           // per patch: where its flags begin in on_border
    // Per position of the overlay of a patch's parent: whether that vertex is on the patch's own border.
    // Eight flags a byte, the first one in the lowest bit.
    Array<uint8_t> on_border;
    std::span<const uint16_t> codes; // those of the following five, in this order; two offsets are a code
    std::span<const uint16_t> border, owned, inner;
    std::span<const uint16_t> internal; // of leaves, below the diagonal, at Numbering::internal_entry()
    std::span<const uint8_t> inner_middles;
    Array<uint16_t> made; // `codes`, unless they lie in a file
};

// The strides of MiddleOffset, of the segments that begin at the places of every ring, and 0 behind the last
// place of each, up to a whole block.
struct MiddleStrides {
    explicit MiddleStrides(std::pmr::memory_resource* memory) : begin(memory), steps(memory) {}

    Array<uint64_t> begin; // per patch
    Array<int16_t> steps;

    const int16_t* of(uint32_t patch) const { return steps.data() + begin[patch]; }
};

// Where the vertex at a position of an overlay is in the two parts of a row.
struct OverlayColumn {
    bool is_owned;
    uint32_t number; // among the owned vertices, or of the own place in the ring
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
// every sample of the parent. Across: for each patch with a long border, or with one beside it, rows for the
// samples of all children of its parent, in the order of their numbers, each with one code for every sample
// of the patch. The few hops across that have no table read that of the parent's overlay. A sample and
// itself are at distance 0. Where a hop up leads to a sample that lies on the border below, too, its distance
// is known there: other ways to it are made longer, by half of what samples are apart. From a sample that
// lies on both borders of a hop across, there is no path to others.
struct Samples {
    explicit Samples(std::pmr::memory_resource* memory)
        : begin(memory), place(memory), spacing(memory), excess(memory), long_begin(memory),
          long_segments(memory), up_begin(memory), across_begin(memory), codes(memory) {}

    static constexpr uint64_t NO_TABLE = std::numeric_limits<uint64_t>::max();

    struct LongSegment {
        uint32_t first, second; // samples, counted from the first one of the border
        float length;
    };

    Array<uint32_t> begin; // per patch
    Array<uint16_t> place; // per sample, counted from the first place of its ring
    Array<float> spacing;  // per patch: how far apart samples are to be, on average
    // Per sample: the length of the border from there to the next sample of its chain, around a closed one,
    // less MOST_LONGER spacings (sssd/samples.h). 0 if that is negative, if no place lies between, and where
    // an open chain ends.
    Array<float> excess;
    Array<uint32_t> long_begin; // per patch: where its long segments begin in `long_segments`
    Array<LongSegment> long_segments;
    Array<uint64_t> up_begin;     // per patch: where its table up begins in `codes`
    Array<uint64_t> across_begin; // per patch: where its table across begins in `codes`, or NO_TABLE
    Array<uint16_t> codes;

    std::span<const uint16_t> of(uint32_t patch) const {
        return {place.data() + begin[patch], place.data() + begin[patch + 1]};
    }
    bool has_table_across(uint32_t patch) const { return across_begin[patch] != NO_TABLE; }
    // The first row for the samples of a patch in the table across of a sibling, which must have one.
    const uint16_t* rows_across(const Numbering& numbering, uint32_t patch, uint32_t sibling) const {
        const uint32_t row = begin[patch] - begin[numbering.child_begin[numbering.parent[patch]]];
        return codes.data() + across_begin[sibling] + size_t{row} * of(sibling).size();
    }
    std::span<const LongSegment> long_segments_of(uint32_t patch) const {
        return {long_segments.data() + long_begin[patch], long_segments.data() + long_begin[patch + 1]};
    }
};

// The labels of vertices: distances to the borders of patches farther out, in steps of quanta of their own.
// A patch is labelled if it is no leaf, its border is neither empty nor long, and at most one patch around it
// is labelled, too. All vertices that lie deeper than its inner vertices have a row to its border, which
// label_rows.h describes, so a vertex has up to two labels. Pairs of vertices that meet outside of a labelled
// patch need not cross the borders inside.
//
// Labels are made patch by patch, each when a pair needs it (see require_labels): what belongs to a labelled
// patch may be read once are_made[patch] has been seen.
struct Labels {
    Labels(uint32_t patches, std::pmr::memory_resource* memory)
        : is_labelled(patches, uint8_t{0}, memory), first_rank(patches, 0, memory), begin(patches, 0, memory),
          run_begin(patches, 0, memory), run_count(patches, 0, memory), runs(memory),
          least_quantum(patches, 0.f, memory), quantum(patches, 0.f, memory),
          are_made(patches, std::pmr::polymorphic_allocator<>(memory)) {}

    Array<uint8_t> is_labelled; // per patch
    // Per patch: the rank of its first inner vertex where patches are visited depth first, each before those
    // in it. In this order the rows to a labelled border follow each other.
    Array<uint32_t> first_rank;
    // Per patch, of labelled ones.
    Array<uint64_t> begin;                // where the rows to its border begin in `rows`
    Array<uint32_t> run_begin, run_count; // where the runs of its rows are in `runs`
    Array<uint16_t> runs;                 // see find_runs()
    Array<float> least_quantum;           // see find_runs(); 0 where runs do not round
    Array<float> quantum;                 // of its rows, once they are made
    Array<std::atomic<bool>> are_made;
    Room<uint8_t> rows; // NULL if no patch is labelled

    std::span<const uint16_t> runs_of(uint32_t patch) const {
        return {runs.data() + run_begin[patch], run_count[patch]};
    }
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
