#include "src/overlay/outer_crossing.h"

namespace geodesic {

OuterCrossing::OuterCrossing(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : index_(index), numbering_(index.numbering), rings_(index.rings), field_(index, memory),
      rows_(index.numbering.largest_overlay_size(), memory), outside_(rows_.size(), memory) {}

bool OuterCrossing::begin(uint32_t child, DistanceField distance, const RingSegments& segments) {
    child_ = child;
    const uint32_t first = rings_.begin[child], places = rings_.size(child);
    const auto border =
        field_.begin(rings_, first, places, index_.quantum[numbering_.parent[child]], segments);
    for (uint32_t k = 0; k < places; ++k) border[k] = distance[rings_.vertex[first + k]];
    const uint16_t* row = index_.hops.outer.data() + index_.outer_row(child, 0);
    for (size_t i = 0; i < rows().size(); ++i) rows_[i] = row + i * places;
    return field_.finish();
}

std::span<float> OuterCrossing::cross(uint16_t* winners) {
    field_.cross(rows(), outside_.data(), winners);
    field_.cross_near(rows(), outside_.data());
    for (uint32_t slot = numbering_.border_begin[child_]; slot < numbering_.border_begin[child_ + 1]; ++slot)
        outside_[numbering_.overlay_position[slot]] = INFINITE;
    return std::span(outside_).first(rows().size());
}

HopTargets OuterCrossing::targets() const {
    const uint32_t parent = numbering_.parent[child_];
    return {rows(), index_.quantum[parent], numbering_.border_of(parent), numbering_.first_inner(parent)};
}

}
