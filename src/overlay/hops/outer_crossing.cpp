#include "src/overlay/hops/outer_crossing.h"

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
    const uint32_t on_border = numbering_.border_size(parent_);
    for (uint32_t i = 0; i < numbering_.overlay_size(parent_); ++i) {
        if (index_.is_on_border(child_, i)) continue;
        if (i < on_border)
            add_on_border(i);
        else
            add_owned(i);
    }
    return crossing_.finish();
}

// Targets on the parent's border come first, also of a sibling's border, which has both kinds in any order.
bool OuterCrossing::begin_to_border(uint32_t child, uint32_t patch, DistanceField distance,
                                    const RingSegments& segments) {
    read_border(child, distance, segments);
    const auto border = numbering_.border_of(patch);
    const auto in_parent = numbering_.positions_in_parent(patch);
    const uint32_t on_border = numbering_.border_size(parent_);
    const auto is_known = [&](uint32_t i) { return distance[border[i]] < INFINITE; };
    for (uint32_t i = 0; i < border.size(); ++i)
        if (const uint32_t position = patch == parent_ ? i : in_parent[i];
            position < on_border && !is_known(i))
            add_on_border(position);
    if (patch != parent_)
        for (uint32_t i = 0; i < border.size(); ++i)
            if (in_parent[i] >= on_border && !is_known(i)) add_owned(in_parent[i]);
    return !numbers_.empty() && crossing_.finish();
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

// A position of the parent's border, which comes first in its overlay.
void OuterCrossing::add_on_border(uint32_t position) {
    const uint32_t slot = numbering_.border_begin[parent_] + position;
    numbers_.push_back(numbering_.border[slot]);
    places_.push_back(rings_.place_of_slot[slot]);
}

// A position behind that border.
void OuterCrossing::add_owned(uint32_t position) {
    const uint32_t owned = position - numbering_.border_size(parent_);
    numbers_.push_back(numbering_.owned_begin[parent_] + owned);
    owned_.push_back(owned);
}

std::span<float> OuterCrossing::cross() {
    crossing_.cross_to_ring(places_, outside_.data());
    crossing_.cross_to_owned(owned_, outside_.data() + places_.size());
    return std::span(outside_).first(numbers_.size());
}

}
