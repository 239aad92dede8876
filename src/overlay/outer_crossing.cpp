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
    read_border(child, distance, segments);
    for (uint32_t i = 0; i < numbering_.overlay_size(parent_); ++i) add(i);
    return crossing_.finish();
}

// Targets on the parent's border come first, also of a sibling's border, which has both kinds in any order.
bool OuterCrossing::begin_to_border(uint32_t child, uint32_t patch, DistanceField distance,
                                    const RingSegments& segments) {
    read_border(child, distance, segments);
    const uint32_t on_border = numbering_.border_size(parent_);
    if (patch == parent_) {
        for (uint32_t i = 0; i < on_border; ++i) add(i);
        return crossing_.finish();
    }
    const auto positions = std::span(numbering_.overlay_position)
                               .subspan(numbering_.border_begin[patch], numbering_.border_size(patch));
    for (const uint32_t i : positions)
        if (i < on_border) add(i);
    for (const uint32_t i : positions)
        if (i >= on_border) add(i);
    return crossing_.finish();
}

void OuterCrossing::read_border(uint32_t child, DistanceField distance, const RingSegments& segments) {
    child_ = child;
    parent_ = numbering_.parent[child];
    const uint32_t first = rings_.begin[child];
    const auto border = crossing_.begin(child, segments);
    for (uint32_t k = 0; k < border.size(); ++k) border[k] = distance[rings_.vertex[first + k]];
    numbers_.clear();
    places_.clear();
    owned_.clear();
}

// A position of the parent's overlay.
void OuterCrossing::add(uint32_t position) {
    if (index_.is_on_border(child_, position)) return;
    numbers_.push_back(numbering_.overlay_number(parent_, position));
    const OverlayColumn column = index_.overlay_column(parent_, position);
    (column.is_owned ? owned_ : places_).push_back(column.number);
}

std::span<float> OuterCrossing::cross() {
    crossing_.cross_to_ring(places_, outside_.data());
    crossing_.cross_to_owned(owned_, outside_.data() + places_.size());
    return std::span(outside_).first(numbers_.size());
}

}
