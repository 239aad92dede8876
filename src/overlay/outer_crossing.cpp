#include "src/overlay/outer_crossing.h"

namespace geodesic {

OuterCrossing::OuterCrossing(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : index_(index), numbering_(index.numbering), rings_(index.rings), crossing_(index, memory),
      numbers_(memory), places_(memory), owned_(memory),
      outside_(index.numbering.largest_overlay_size(), memory) {
    numbers_.reserve(outside_.size());
    places_.reserve(index.numbering.largest_border_size());
    owned_.reserve(index.numbering.largest_inner_size());
}

bool OuterCrossing::begin(uint32_t child, DistanceField distance, const RingSegments& segments) {
    const uint32_t parent = numbering_.parent[child];
    const uint32_t first = rings_.begin[child];
    const auto border = crossing_.begin(child, segments);
    for (uint32_t k = 0; k < border.size(); ++k) border[k] = distance[rings_.vertex[first + k]];
    numbers_.clear();
    places_.clear();
    owned_.clear();
    for (uint32_t i = 0; i < numbering_.overlay_size(parent); ++i) {
        if (index_.is_on_border(child, i)) continue;
        numbers_.push_back(numbering_.overlay_number(parent, i));
        const OverlayColumn column = index_.overlay_column(parent, i);
        (column.is_owned ? owned_ : places_).push_back(column.number);
    }
    return crossing_.finish();
}

std::span<float> OuterCrossing::cross() {
    crossing_.cross_to_ring(places_, outside_.data());
    crossing_.cross_to_owned(owned_, outside_.data() + places_.size());
    return std::span(outside_).first(numbers_.size());
}

}
