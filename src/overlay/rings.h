#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <span>
#include <vector>

#include "src/base/array.h"
#include "src/index/numbering.h"

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

    // The own places of a chain's vertices, counted over all rings.
    struct ChainPlaces {
        uint32_t first, last;
        uint32_t is_closed;
    };

    Array<uint32_t> begin; // per patch
    // Per place.
    Array<uint32_t> position;    // in the border
    Array<uint32_t> vertex;      // its number
    Array<float> segment_length; // of the segment to the next place; GAP: there is none
    Array<float> half_inverse;   // 0.5 / segment_length
    Array<int32_t> is_own;       // -1: the vertex's own place; 0: a repetition
    Array<uint32_t> chain;       // which of `chains`
    Array<ChainPlaces> chains;

    uint32_t size(uint32_t patch) const { return begin[patch + 1] - begin[patch]; }
    uint32_t largest_size() const {
        uint32_t largest = 0;
        for (size_t p = 0; p + 1 < begin.size(); ++p) largest = std::max(largest, begin[p + 1] - begin[p]);
        return largest;
    }
};

// The rings of all vertices of all borders.
struct BorderRings : Rings {
    explicit BorderRings(std::pmr::memory_resource* memory) : Rings(memory), place_of_slot(memory) {}

    Array<uint32_t> place_of_slot; // a border vertex's own place in the patch's ring
};

// Border segments, per slot: the position, in the same border, of the vertex at the other end of an edge
// along the border, or NONE, and the length of the edge. It is the next position, or, closing a chain of
// such, the chain's first.
struct BorderSegments {
    std::vector<uint32_t> end;
    std::vector<float> length;

    explicit BorderSegments(size_t slots) : end(slots, NONE), length(slots, 0) {}
};

// Vertices of a border, each joined to the next by a segment.
struct Chain {
    std::vector<uint32_t> positions; // in the border
    std::vector<float> lengths; // of the segment to the next, of the last one to the first if it is closed
    bool is_closed = false;
};

// Fills the rings of one patch after the other.
class RingWriter {
public:
    explicit RingWriter(Rings& rings) : rings_(rings) {}

    void begin();
    void add_chain(const Chain& chain, std::span<const uint32_t> border);
    void end_ring(); // throws Error LIMIT where it is too long
    void end();

private:
    Rings& rings_;
};

std::vector<Chain> chains_of_ring(const Rings& rings, uint32_t patch);

// Fills empty rings. Throws Error CORRUPT where a segment joins other positions than it may.
void lay_out_rings(std::span<const uint32_t> segment_end, std::span<const float> segment_length,
                   const Numbering& numbering, BorderRings& rings);

// The opposite.
BorderSegments segments_of_rings(const BorderRings& rings, const Numbering& numbering);

}
