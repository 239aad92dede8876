#pragma once

#include <memory_resource>
#include <span>

#include "src/base/array.h"
#include "src/index/numbering.h"

namespace geodesic {

// From overlay positions back to slots (see Numbering): on the borders of which children a vertex of a
// patch's overlay is. Only searches from child to child need this.
struct Slots {
    explicit Slots(std::pmr::memory_resource* memory)
        : patch_of_slot(memory), overlay_begin(memory), begin(memory), slots(memory) {}

    Array<uint32_t> patch_of_slot;
    Array<uint32_t> overlay_begin; // per inner patch: where its overlay positions begin in `begin`
    // The slots of overlay position i of patch p begin at slots[begin[overlay_begin[p] + i]].
    Array<uint32_t> begin;
    Array<uint32_t> slots;

    std::span<const uint32_t> of(uint32_t patch, uint32_t overlay_position) const {
        const uint32_t* first = begin.data() + overlay_begin[patch] + overlay_position;
        return {slots.data() + first[0], slots.data() + first[1]};
    }
};

// Fills empty slots from a numbering that is complete.
void find_slots(const Numbering& numbering, Slots& slots);

}
