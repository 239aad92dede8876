#pragma once

#include <memory_resource>

#include "src/overlay/labels.h"
#include "src/overlay/tables.h"

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

// The label of a vertex that lies deeper inside of a labelled patch than its inner vertices.
inline RingRow label_of(const OverlayIndex& index, uint32_t vertex, uint32_t labelled) {
    const Numbering& numbering = index.numbering;
    const Labels& labels = *index.pairs.labels;
    require_labels(index, labelled);
    const uint32_t patch = numbering.innermost_patch(vertex);
    const uint64_t row = uint64_t{vertex - numbering.first_inner(patch)} * index.rings.size(labelled);
    return {labels.codes.get() + labels.begin[patch] + row, index.rings.begin[labelled],
            labels.quantum[labelled]};
}

// One end of a path and the patches whose borders the path crosses, each the parent of the one before it:
// from the outermost patch of which the index holds the distances from the vertex to the whole border, up to
// a child of the patch where the ends meet. There is none if the end is an inner vertex of the patch where
// the ends meet.
struct Ascent {
    explicit Ascent(std::pmr::memory_resource* memory) : patches(memory) {}

    uint32_t last_patch() const { return patches.back(); }

    uint32_t vertex = 0;
    Array<uint32_t> patches;
    RingRow first_row; // from the vertex to the border of the first patch
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
    ascent.vertex = NONE;
    ascent.patches.clear();
    ascent.first_row = {end.row, index.rings.begin[end.leaf], end.quantum};
    for (uint32_t patch = end.leaf; patch != top; patch = index.numbering.parent[patch])
        ascent.patches.push_back(patch);
}

// Climbs from a vertex up to a child of `top`.
inline void climb(const OverlayIndex& index, uint32_t vertex, uint32_t top, Ascent& ascent) {
    const Numbering& numbering = index.numbering;
    const uint32_t innermost = numbering.innermost_patch(vertex);
    ascent.vertex = vertex;
    ascent.patches.clear();
    if (innermost == top) return;
    ascent.first_row = inner_row_of(index, vertex);
    for (uint32_t patch = innermost; patch != top; patch = numbering.parent[patch]) {
        if (patch != innermost && index.pairs.labels->is_labelled[patch]) {
            ascent.patches.clear();
            ascent.first_row = label_of(index, vertex, patch);
        }
        ascent.patches.push_back(patch);
    }
}

}
