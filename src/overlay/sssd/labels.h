#pragma once

#include <cstdint>
#include <memory_resource>

#include "src/overlay/sssd/label_rows.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// A labelled border has at most so many places.
constexpr uint32_t MOST_LABEL_PLACES = 400;

// The number of codes in all labels. Needs the rings of the index.
uint64_t count_label_codes(const OverlayIndex& index);

// Chooses the patches to label and reserves memory for their labels; makes none. Needs the rings of the
// index.
Labels lay_out_labels(const OverlayIndex& index, std::pmr::memory_resource* memory);

// Makes the labels of a labelled patch, or those of all of them, unless they are made: one thread does, under
// the lock of the pair tables, which are no part of the index's value. Any thread may call these at any time,
// once the index has its pair tables.
void make_labels(const OverlayIndex& index, uint32_t patch);
void make_all_labels(const OverlayIndex& index);

// The size of each row to the border of a labelled patch.
inline size_t label_row_size(const OverlayIndex& index, const Labels& labels, uint32_t labelled) {
    return label_row_size(index.rings.size(labelled), labels.runs_of(labelled).size());
}

// Where the row of an inner vertex of a patch, to the border of a labelled patch that it lies in, begins in
// the rows of all labels. The inner vertices of the patch have theirs one after the other.
inline uint64_t label_row_begin(const OverlayIndex& index, const Labels& labels, uint32_t patch,
                                uint32_t inner, uint32_t labelled) {
    const uint32_t row =
        labels.first_rank[patch] + inner - labels.first_rank[labelled] - index.numbering.inner_size(labelled);
    return labels.begin[labelled] + uint64_t{row} * label_row_size(index, labels, labelled);
}

// Makes sure that a labelled patch has its labels.
inline void require_labels(const OverlayIndex& index, uint32_t patch) {
    if (!index.pairs.labels->are_made[patch].load(std::memory_order_acquire)) make_labels(index, patch);
}

}
