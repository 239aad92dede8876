#pragma once

#include <cstdint>
#include <memory_resource>

#include "src/overlay/tables.h"

namespace geodesic {

// The number of codes in all labels, without padding. Needs the rings of the index.
uint64_t count_label_codes(const OverlayIndex& index);

// Chooses the patches to label and reserves memory for their labels; makes none. Needs the rings of the
// index.
Labels lay_out_labels(const OverlayIndex& index, std::pmr::memory_resource* memory);

// Makes the labels of a labelled patch, or those of all of them, unless they are made: one thread does, under
// the lock of the pair tables, which are no part of the index's value. Any thread may call these at any time,
// once the index has its pair tables.
void make_labels(const OverlayIndex& index, uint32_t patch);
void make_all_labels(const OverlayIndex& index);

// Makes sure that a labelled patch has its labels.
inline void require_labels(const OverlayIndex& index, uint32_t patch) {
    if (!index.pairs.labels->are_made[patch].load(std::memory_order_acquire)) make_labels(index, patch);
}

}
