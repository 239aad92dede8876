#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/index/index.h"

namespace geodesic {

// Border segments, per slot: the position, in the same border, of the vertex at the other end of an edge
// along the border, or NONE, and the length of the edge. It is the next position, or, closing a chain of
// such, the chain's first.
struct BorderSegments {
    explicit BorderSegments(size_t slots) : next(slots, NONE), length(slots, 0) {}

    std::vector<uint32_t> next;
    std::vector<float> length;
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

// Fills index.overlay_tables.rings and place_of_slot. Throws Error CORRUPT where a segment joins other
// positions than it may.
void lay_out_rings(const BorderSegments& segments, Index& index);

BorderSegments segments_of_rings(const Index& index);

}
