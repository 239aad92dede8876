#pragma once

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

namespace geodesic {

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
// of the patch. There are none where they would be out of proportion to the table of the parent's overlay, as
// where many patches share few vertices. A hop across for which there is no table reads that of the overlay.
// A sample and itself are at distance 0. Where a hop up leads to a sample that lies on the border below, too,
// its distance is known there: other ways to it are made longer, by half of what samples are apart. From a
// sample that lies on both borders of a hop across, there is no path to others.
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

}
