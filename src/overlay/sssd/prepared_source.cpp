#include "src/overlay/sssd/prepared_source.h"

#include <algorithm>

#include "src/overlay/kernels/dispatch.h"
#include "src/overlay/ring_segments.h"
#include "src/overlay/sssd/ascent.h"

namespace geodesic {

void PreparedSource::prepare(const Sources& source, OverlaySsad& field) {
    known_.resize(index_.numbering.vertex_count());
    for (auto* distances : {&from_, &to_})
        distances->resize(SourceCode::whole_blocks(index_.rings.largest_size()) + SourceCode::BLOCK);
    field.sweep_borders(source, known_);
}

// The kernel reads past the ring up to whole blocks; infinity there gives no way.
float PreparedSource::distance(uint32_t target) {
    const float known = known_[target];
    if (known < INFINITE || index_.numbering.is_border(target)) return known;
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
