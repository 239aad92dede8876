#include "src/index/slots.h"

#include <algorithm>
#include <vector>

namespace geodesic {

namespace {

void find_patches(const Numbering& numbering, Slots& slots) {
    slots.patch_of_slot.resize(numbering.border.size());
    for (uint32_t p = 0; p < numbering.patch_count(); ++p)
        std::fill(slots.patch_of_slot.begin() + numbering.border_begin[p],
                  slots.patch_of_slot.begin() + numbering.border_begin[p + 1], p);
}

}

// Each overlay position has a slot, so that there are no more positions than slots, whose count fits 32 bits.
void find_slots(const Numbering& numbering, Slots& slots) {
    find_patches(numbering, slots);
    slots.overlay_begin.assign(1, 0);
    for (uint32_t p = 0; p < numbering.first_leaf(); ++p)
        slots.overlay_begin.push_back(slots.overlay_begin.back() + numbering.overlay_size(p));
    const auto overlay_of = [&](size_t slot) {
        return slots.overlay_begin[numbering.parent[slots.patch_of_slot[slot]]] +
               numbering.overlay_position[slot];
    };
    slots.begin.assign(size_t{slots.overlay_begin.back()} + 1, 0);
    for (size_t slot = 0; slot < numbering.border.size(); ++slot) ++slots.begin[overlay_of(slot) + 1];
    for (size_t i = 1; i < slots.begin.size(); ++i) slots.begin[i] += slots.begin[i - 1];
    slots.slots.resize(numbering.border.size());
    std::vector<uint32_t> next(slots.begin.begin(), slots.begin.end() - 1);
    for (uint32_t slot = 0; slot < numbering.border.size(); ++slot)
        slots.slots[next[overlay_of(slot)]++] = slot;
}

}
