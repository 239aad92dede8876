#include "src/overlay/sssd/prepared_source.h"

#include <algorithm>

#include "src/overlay/kernels/dispatch.h"
#include "src/overlay/ring_segments.h"
#include "src/overlay/sssd/ascent.h"

namespace geodesic {

// The distances of internal vertices are read in the source's own leaf only.
void PreparedSource::prepare(const Sources& source) {
    const Numbering& numbering = index_.numbering;
    known_.resize(numbering.vertex_count());
    std::fill_n(known_.begin(), numbering.border_vertex_count(), INFINITE);
    for (auto* distances : {&from_, &to_})
        distances->resize(SourceCode::whole_blocks(index_.rings.largest_size()) + SourceCode::BLOCK);
    source.for_each_way(index_, source.keys.front(),
                        [&](uint32_t number, float way) { known_[number] = way; });
    is_known_.assign(numbering.patch_count(), 0);
    innermost_ = top_ = source.innermost_patch(numbering, source.keys.front());
    is_known_[innermost_] = 1;
}

// A patch around the source has its inner vertices in its overlay, which a hop up from the patch below leads
// to. To those of any other patch a hop down leads, from its border, which is in the overlay of its parent.
void PreparedSource::require_inner(uint32_t patch, OverlaySsad& field) {
    if (is_known_[patch]) return;
    const Numbering& numbering = index_.numbering;
    if (numbering.is_within(innermost_, patch)) {
        while (top_ != patch) {
            field.hop_up(top_, known_);
            top_ = numbering.parent[top_];
            is_known_[top_] = 1;
        }
        return;
    }
    require_inner(numbering.parent[patch], field);
    field.hop_down(patch, known_);
    is_known_[patch] = 1;
}

float PreparedSource::distance(uint32_t target, OverlaySsad& field) {
    const uint32_t patch = index_.numbering.innermost_patch(target);
    const bool is_border = index_.numbering.is_border(target);
    if (is_border || patch == innermost_) {
        require_inner(patch, field);
        return known_[target];
    }
    require_inner(index_.numbering.parent[patch], field);
    return distance_over_border(target);
}

// The kernel reads past the ring up to whole blocks; infinity there gives no way.
float PreparedSource::distance_over_border(uint32_t target) {
    const RingRow row = inner_row_of(index_, target);
    const uint32_t places = index_.rings.size(index_.numbering.leaf_of(target));
    const uint32_t* vertex = index_.rings.vertex.data() + row.first;
    for (uint32_t k = 0; k < places; ++k) {
        from_[k] = known_[vertex[k]];
        to_[k] = row(row.first + k);
    }
    for (auto* distances : {&from_, &to_})
        std::fill_n(distances->begin() + places, SourceCode::BLOCK, INFINITE);
    const RingSegments segments = segments_from(index_.rings, row.first);
    return runnable_kernels().back().meet(
        {places, from_.data(), to_.data(), segments.length, segments.half_inverse});
}

}
