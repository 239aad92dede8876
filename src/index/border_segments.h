#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/base/numbers.h"

namespace geodesic {

// A segment whose ends do not follow each other along a border: where chains meet, as at edges that three or
// more triangles share, and where a border comes through one vertex twice.
struct Bridge {
    uint32_t slot; // at which it begins (see Numbering)
    uint32_t end;  // the position of its other end in the same border, behind that of the slot
    float length;

    friend bool operator==(const Bridge&, const Bridge&) = default;
};

// Border segments: those of chains per slot (see Numbering), and the others. `end` is the position, in the
// same border, of the vertex at the other end of a segment that begins at the slot, or NONE, and `length` is
// the length of the segment. The other end is the next position or, where the segment closes a chain, the
// first position of the chain.
struct BorderSegments {
    std::vector<uint32_t> end;
    std::vector<float> length;
    // In ascending order of their slots, then of their ends. A border has no more than it has vertices.
    std::vector<Bridge> bridges;

    BorderSegments() = default;
    explicit BorderSegments(size_t slots) : end(slots, NONE), length(slots, 0) {}
};

}
