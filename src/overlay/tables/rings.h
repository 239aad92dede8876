#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <span>
#include <vector>

#include "src/base/array.h"
#include "src/index/border_segments.h"
#include "src/index/numbering.h"
#include "src/overlay/tables/codes.h"

namespace geodesic {

// The border of each patch as a *ring*: an array with a place for each vertex of the border, in the order of
// the border. Two places side by side are the ends of a segment or of a gap. At each end of a chain, two more
// places repeat vertices: those that follow around a closed chain, or the end of an open one. So every
// vertex's own place has two segments or gaps on each side. Behind all chains, two places for each bridge
// repeat its ends.
struct Rings {
    // A path over a border vertex is straightened over this many segments on each side of it.
    static constexpr uint32_t REACH = 2;
    static constexpr uint32_t MOST_PLACES = 0x7fff; // the largest size of a ring
    static constexpr size_t MOST_PLACES_OF_ALL = size_t{1} << 31;
    static constexpr size_t PADDING = 32; // unused places that follow the last ring
    // Stands for a length where there is no segment.
    static constexpr float GAP = std::numeric_limits<float>::quiet_NaN();

    explicit Rings(std::pmr::memory_resource* memory)
        : begin(memory), position(memory), vertex(memory), segment_length(memory), half_inverse(memory),
          is_own(memory), chain_begin(memory), chains(memory), place_of_slot(memory) {}

    // The first and the last own place of a chain's vertices, counted over all rings. A chain is a sequence
    // of vertices each of which is joined to the next one by a segment.
    struct Chain {
        uint32_t first, last;
        uint32_t is_closed;
    };

    Array<uint32_t> begin; // per patch
    // Per place.
    Array<uint16_t> position;      // the vertex's position in the border
    Array<uint32_t> vertex;        // the vertex's number
    Array<float> segment_length;   // of the segment to the next place; GAP if there is none
    Array<float> half_inverse;     // 0.5 / segment_length
    Array<int8_t> is_own;          // -1 at the vertex's own place, 0 where it is repeated
    Array<uint32_t> chain_begin;   // per patch: where its chains begin
    Array<Chain> chains;           // in the order of their places
    Array<uint16_t> place_of_slot; // per slot: the vertex's own place in the ring of its patch

    uint32_t size(uint32_t patch) const { return begin[patch + 1] - begin[patch]; }
    std::span<const Chain> chains_of(uint32_t patch) const {
        return {chains.data() + chain_begin[patch], chains.data() + chain_begin[patch + 1]};
    }
    // The chain of a patch's border that has an own place, counted over all rings.
    const Chain& chain_at(uint32_t patch, uint32_t own) const {
        return *std::ranges::lower_bound(chains_of(patch), own, {}, &Chain::last);
    }
    // Where the places of a patch's bridges begin, counted over all rings. They end with the ring.
    uint32_t bridges_begin(uint32_t patch) const {
        const auto chains = chains_of(patch);
        return chains.empty() ? begin[patch] : chains.back().last + 1 + REACH;
    }
    uint32_t bridge_places(uint32_t patch) const { return begin[patch + 1] - bridges_begin(patch); }
    uint32_t largest_size() const {
        uint32_t largest = 0;
        for (size_t p = 0; p + 1 < begin.size(); ++p) largest = std::max(largest, begin[p + 1] - begin[p]);
        return largest;
    }
    // Room for the places of any ring in whole blocks of codes, and for the block of infinite distances that
    // kernels may read behind the last place.
    size_t room_for_places() const { return SourceCode::whole_blocks(largest_size()) + SourceCode::BLOCK; }
};

// The own place of a vertex of a patch's border, counted over all rings.
inline uint32_t own_place(const Rings& rings, const Numbering& numbering, uint32_t patch, uint32_t position) {
    return rings.begin[patch] + rings.place_of_slot[numbering.border_begin[patch] + position];
}

// Calls use(place, length) for each bridge of a border. It begins at a place, counted over all rings, and
// ends at the next one.
template <class Use>
void for_each_bridge(const Rings& rings, uint32_t patch, const Use& use) {
    for (uint32_t k = rings.bridges_begin(patch); k < rings.begin[patch + 1]; k += 2)
        use(k, rings.segment_length[k]);
}

// The same for each segment, bridges among them.
template <class Use>
void for_each_segment(const Rings& rings, uint32_t patch, const Use& use) {
    for (uint32_t k = rings.begin[patch]; k < rings.bridges_begin(patch); ++k)
        if (rings.is_own[k] && !std::isnan(rings.segment_length[k])) use(k, rings.segment_length[k]);
    for_each_bridge(rings, patch, use);
}

// Calls use(other, length) for each segment between a position of a patch's border and another one.
template <class Use>
void for_each_joined(const Rings& rings, const Numbering& numbering, uint32_t patch, uint32_t position,
                     const Use& use) {
    const auto use_next = [&](uint32_t place) {
        if (!std::isnan(rings.segment_length[place]))
            use(rings.position[place + 1], rings.segment_length[place]);
    };
    const auto use_previous = [&](uint32_t place) {
        if (!std::isnan(rings.segment_length[place - 1]))
            use(rings.position[place - 1], rings.segment_length[place - 1]);
    };
    const uint32_t own = own_place(rings, numbering, patch, position);
    use_next(own);
    use_previous(own);
    for_each_bridge(rings, patch, [&](uint32_t place, float) {
        if (rings.position[place] == position) use_next(place);
        if (rings.position[place + 1] == position) use_previous(place + 1);
    });
}

// Fills empty rings from the stored segments. Throws Error CORRUPT where a segment does not end at the next
// position or at the first of its chain, or where bridges are not in order, and LIMIT where a ring has too
// many places.
void lay_out_rings(const BorderSegments& segments, const Numbering& numbering, Rings& rings);

// The segments from which lay_out_rings() made these rings.
BorderSegments segments_of_rings(const Rings& rings, const Numbering& numbering);

}
