#include "src/overlay/border_sources.h"

#include <algorithm>

#include "src/overlay/codes.h"

namespace geodesic {

namespace {

constexpr float GAP = Rings::GAP;

}

BorderSources::BorderSources(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : rings_(index.rings), source_(memory), length_(memory), half_inverse_(memory) {
    const size_t room = SourceCode::whole_blocks(rings_.largest_size()) + SourceCode::BLOCK;
    source_.resize(room);
    length_.resize(room, GAP);
    half_inverse_.resize(room, GAP);
}

void BorderSources::read(uint32_t patch, const float* distance, const uint32_t* nearest_source) {
    const uint32_t first = rings_.begin[patch], places = rings_.size(patch);
    const uint32_t* vertex = rings_.vertex.data() + first;
    all_segments_ = segments_from(rings_, first);
    any_ = NONE;
    are_several_ = false;
    for (uint32_t k = 0; k < places; ++k) {
        source_[k] = distance[vertex[k]] < INFINITE ? nearest_source[vertex[k]] : NONE;
        if (source_[k] == NONE) continue;
        if (any_ == NONE) any_ = source_[k];
        are_several_ = are_several_ || source_[k] != any_;
    }
    if (are_several_) leave_gaps(places);
}

void BorderSources::leave_gaps(uint32_t places) {
    for (uint32_t k = 0; k < places; ++k) {
        const bool has_one = k + 1 < places && source_[k] == source_[k + 1];
        length_[k] = has_one ? all_segments_.length[k] : GAP;
        half_inverse_[k] = has_one ? all_segments_.half_inverse[k] : GAP;
    }
    std::fill_n(length_.begin() + places, SourceCode::BLOCK, GAP);
    std::fill_n(half_inverse_.begin() + places, SourceCode::BLOCK, GAP);
}

}
