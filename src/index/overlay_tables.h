#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <span>
#include <vector>

namespace geodesic {

// The border of each patch as a *ring*: a place for each vertex, or for some of them, in the order of the
// border, so that places side by side are the ends of a segment or of a gap. Where segments form a chain, two
// places at each of its ends repeat what follows around it if it is closed, and its end if it is open: there
// are two segments, or gaps, on each side of every vertex's own place.
struct Rings {
    // Segments on each side of a border vertex that a path over it is straightened over.
    static constexpr uint32_t REACH = 2;
    static constexpr uint32_t MOST_PLACES = 0x7fff;                       // in a ring
    static constexpr size_t PADDING = 32;                                 // places of nothing at the end
    static constexpr float GAP = std::numeric_limits<float>::quiet_NaN(); // the length of no segment

    explicit Rings(std::pmr::memory_resource* memory)
        : begin(memory), position(memory), vertex(memory), segment_length(memory), half_inverse(memory),
          is_own(memory), chain(memory), chains(memory) {}

    // The own places of its vertices, counted over all rings.
    struct Chain {
        uint32_t first, last;
        uint32_t is_closed;
    };

    std::pmr::vector<uint32_t> begin; // per patch
    // Per place.
    std::pmr::vector<uint32_t> position;    // in the border
    std::pmr::vector<uint32_t> vertex;      // its number
    std::pmr::vector<float> segment_length; // of the segment to the next place; NaN: a gap
    std::pmr::vector<float> half_inverse;   // 0.5 / segment_length
    std::pmr::vector<int32_t> is_own;       // -1: the vertex's own place; 0: a repetition
    std::pmr::vector<uint32_t> chain;       // which of `chains`
    std::pmr::vector<Chain> chains;

    uint32_t size(uint32_t patch) const { return begin[patch + 1] - begin[patch]; }
    uint32_t largest_size() const {
        uint32_t largest = 0;
        for (size_t p = 0; p + 1 < begin.size(); ++p) largest = std::max(largest, begin[p + 1] - begin[p]);
        return largest;
    }
};

// What the overlay engine reads besides the hierarchy. Distances are codes: code * quantum of a patch.
struct OverlayTables {
    static constexpr uint16_t LARGEST = 0x7ffe;
    static constexpr uint16_t UNREACHED = 0x7fff;
    static constexpr float NEAR = 5;      // up to so many times the longest segment of a ring is near
    static constexpr size_t PADDING = 32; // codes at the end: rows are read in blocks of up to this many

    explicit OverlayTables(std::pmr::memory_resource* memory)
        : quantum(memory), rings(memory), place_of_slot(memory), outer_begin(memory), inner_begin(memory),
          outer_tables(memory), inner_tables(memory), inner_middles(memory), internal_tables(memory),
          coarse_rings(memory), coarse_places(memory), coarse_samples(memory), sample_begin(memory),
          sample_positions(memory), sample_spacing(memory), near(memory), coarse_rows(memory),
          coarse_positions_begin(memory), coarse_positions(memory), coarse_begin(memory),
          coarse_tables(memory), label_offset(memory), label_begin(memory), labels(memory) {}

    float distance(uint16_t code, uint32_t patch) const {
        return code == UNREACHED ? std::numeric_limits<float>::infinity()
                                 : static_cast<float>(code) * quantum[patch];
    }

    std::span<const uint32_t> samples_of(uint32_t patch) const {
        return {sample_positions.data() + sample_begin[patch],
                sample_positions.data() + sample_begin[patch + 1]};
    }

    std::pmr::vector<float> quantum; // per patch

    Rings rings;                              // of all border vertices
    std::pmr::vector<uint32_t> place_of_slot; // its own place in the patch's ring

    // The tables of a patch have a row of codes, one a place of its ring, for everything that is one hop away
    // from its border: in the outer table the overlay of its parent, by the parent's quantum, in the inner
    // one, by its own, the vertices that it owns or those inside of a leaf. A sweep down reads all inner
    // tables, and beside them the codes of the middle of the segment that begins at a place.
    std::pmr::vector<uint64_t> outer_begin, inner_begin; // per patch
    std::pmr::vector<uint16_t> outer_tables, inner_tables, inner_middles;
    std::pmr::vector<uint16_t> internal_tables; // placed as those of Index

    // A sample of each ring, and of the outer tables, which SSSD looks for a way in first. The coarse table
    // of a patch has rows for the samples of its parent's ring and of its siblings' and its own, in this
    // order; that of a ring whose vertices are all samples is not stored: its rows are in the outer table.
    Rings coarse_rings;
    // Per place of coarse_rings: the own place of the same vertex in `rings`, counted over all, and which of
    // the ring's samples it is.
    std::pmr::vector<uint32_t> coarse_places, coarse_samples;
    std::pmr::vector<uint32_t> sample_begin;     // per patch
    std::pmr::vector<uint32_t> sample_positions; // in the border
    std::pmr::vector<float> sample_spacing;      // per patch: from a sample to the next one, on average
    std::pmr::vector<float> near;                // per patch: up to which distance SSSD looks everywhere
    std::pmr::vector<uint32_t> coarse_rows; // per patch: its samples' first row in the tables of its siblings
    std::pmr::vector<uint32_t> coarse_positions_begin; // per inner patch
    std::pmr::vector<uint32_t> coarse_positions; // of these rows, in the parent's overlay, parent by parent
    std::pmr::vector<uint64_t> coarse_begin;     // per patch
    std::pmr::vector<uint16_t> coarse_tables;

    // The label of a vertex: its distances to the borders of the patches that it lies in beyond the first one
    // (Index::entry()), from the outermost one inwards, without the whole mesh, in steps of the quantum of
    // that patch's parent: the nearest one's, its low half and its high one, then how much longer each is
    // (StepsOf), to all of a border that has no more than so many vertices, in its order, or to the samples
    // of its ring.
    static constexpr uint32_t LABELLED_WHOLE = 400;
    static constexpr uint32_t LABEL_HEAD = 2;
    std::pmr::vector<uint32_t> label_offset; // per patch: where its border begins in the labels of what lies
                                             // deeper; where the labels of what lies just inside end
    std::pmr::vector<uint64_t> label_begin;  // per patch: of what lies just inside
    std::pmr::vector<int16_t> labels;
};

}
