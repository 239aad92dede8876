#include "src/overlay/outer_crossing.h"

namespace geodesic {

OuterCrossing::OuterCrossing(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : index_(index), numbering_(index.numbering), rings_(index.rings), field_(index, memory), rows_(memory),
      numbers_(memory), outside_(index.numbering.largest_overlay_size(), memory) {
    rows_.reserve(outside_.size());
    numbers_.reserve(outside_.size());
}

bool OuterCrossing::begin(uint32_t child, DistanceField distance, const RingSegments& segments) {
    const uint32_t parent = numbering_.parent[child];
    const uint32_t first = rings_.begin[child], places = rings_.size(child);
    const auto border = field_.begin(rings_, first, places, index_.quantum[parent], segments);
    for (uint32_t k = 0; k < places; ++k) border[k] = distance[rings_.vertex[first + k]];
    rows_.clear();
    numbers_.clear();
    for (uint32_t i = 0; i < numbering_.overlay_size(parent); ++i)
        if (const uint16_t* const row = index_.outer_row(child, i)) {
            rows_.push_back(row);
            numbers_.push_back(numbering_.overlay_number(parent, i));
        }
    return field_.finish();
}

std::span<float> OuterCrossing::cross() {
    field_.cross(rows_, outside_.data());
    field_.cross_near(rows_, outside_.data());
    return std::span(outside_).first(rows_.size());
}

}
