#pragma once

#include <memory_resource>

#include "src/base/prefetch.h"
#include "src/overlay/sssd/labels.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// The distances that a row of a table holds, one for each place of a ring. Places are counted over all rings.
struct RingRow {
    const uint16_t* codes = nullptr;
    size_t first = 0; // the first place of the ring
    float quantum = 0;

    float operator()(size_t place) const { return TableCode::distance(codes[place - first], quantum); }
};

// The row of a vertex to the ring of the innermost patch around it.
inline RingRow inner_row_of(const OverlayIndex& index, uint32_t vertex) {
    const uint32_t patch = index.numbering.innermost_patch(vertex);
    return {index.hops.inner.data() + index.inner_row(patch, vertex - index.numbering.first_inner(patch)),
            index.rings.begin[patch], index.quantum[patch]};
}

// The row of the label of a vertex that lies deeper inside of a labelled patch than its inner vertices.
inline const uint8_t* label_row_of(const OverlayIndex& index, uint32_t vertex, uint32_t labelled) {
    const Numbering& numbering = index.numbering;
    require_labels(index, labelled);
    const Labels& labels = *index.pairs.labels;
    const uint32_t patch = numbering.innermost_patch(vertex);
    return labels.rows.get() +
           label_row_begin(index, labels, patch, vertex - numbering.first_inner(patch), labelled);
}

// One end of a path and the patches whose borders the path crosses, each the parent of the one before it:
// from the outermost patch of which the index holds the distances from the vertex to the whole border, up to
// a child of the patch where the ends meet. There is none if the end is an inner vertex of the patch where
// the ends meet.
struct Ascent {
    Ascent(const OverlayIndex& index, std::pmr::memory_resource* memory)
        : patches(memory), label_codes(MOST_LABEL_PLACES + LABEL_ROW_PADDING, memory) {
        patches.reserve(index.numbering.level_count());
    }

    // Begins anew, with a vertex or with NONE.
    void begin(uint32_t from) {
        vertex = from;
        patches.clear();
        label_quantum = 0;
        unread_label = nullptr;
    }
    uint32_t last_patch() const { return patches.back(); }

    uint32_t vertex = 0;
    Array<uint32_t> patches;
    RingRow first_row;                     // from the vertex to the border of the first patch
    float label_quantum = 0;               // of that row, if it is a label, and otherwise 0
    const uint8_t* unread_label = nullptr; // what read_label() has yet to read the first row from, or NULL
    Array<uint16_t> label_codes;           // of the first row, if it is a label
};

// The end of a path: a vertex, or a point of a face with its row to the ring of a leaf (see fill_row).
struct PathEnd {
    uint32_t vertex = NONE;
    uint32_t leaf = NONE; // of a point
    const uint16_t* row = nullptr;
    float quantum = 0; // of the row
};

// The innermost patch around an end.
inline uint32_t innermost_patch(const Numbering& numbering, const PathEnd& end) {
    return end.vertex == NONE ? end.leaf : numbering.innermost_patch(end.vertex);
}

// Climbs from a point, which has no labels, up to a child of `top`.
inline void climb_from_point(const OverlayIndex& index, const PathEnd& end, uint32_t top, Ascent& ascent) {
    ascent.begin(NONE);
    ascent.first_row = {end.row, index.rings.begin[end.leaf], end.quantum};
    for (uint32_t patch = end.leaf; patch != top; patch = index.numbering.parent[patch])
        ascent.patches.push_back(patch);
}

// Climbs from a vertex up to a child of `top`. A label is asked for, and read by read_label() later,
// so that the rows of both ends are loaded at the same time.
inline void climb(const OverlayIndex& index, uint32_t vertex, uint32_t top, bool with_labels,
                  Ascent& ascent) {
    const Numbering& numbering = index.numbering;
    const uint32_t innermost = numbering.innermost_patch(vertex);
    ascent.begin(vertex);
    if (innermost == top) return;
    uint32_t labelled = NONE;
    for (uint32_t patch = innermost; patch != top; patch = numbering.parent[patch]) {
        if (with_labels && patch != innermost && index.pairs.labels->is_labelled[patch]) {
            ascent.patches.clear();
            labelled = patch;
        }
        ascent.patches.push_back(patch);
    }
    if (labelled != NONE) {
        ascent.unread_label = label_row_of(index, vertex, labelled);
        ascent.label_quantum = index.pairs.labels->quantum[labelled];
        prefetch(ascent.unread_label, label_row_size(index, *index.pairs.labels, labelled));
    } else {
        ascent.first_row = inner_row_of(index, vertex);
        prefetch(ascent.first_row.codes, index.rings.size(innermost));
    }
}

// Reads the label that a climb has found, if it has.
inline void read_label(const OverlayIndex& index, Ascent& ascent) {
    if (!ascent.unread_label) return;
    const Labels& labels = *index.pairs.labels;
    const uint32_t labelled = ascent.patches.front();
    read_label_row(ascent.unread_label, labels.runs_of(labelled), index.rings.size(labelled),
                   ascent.label_codes.data());
    ascent.first_row = {ascent.label_codes.data(), index.rings.begin[labelled], ascent.label_quantum};
    ascent.unread_label = nullptr;
}

}
