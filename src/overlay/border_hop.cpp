#include "src/overlay/border_hop.h"

#include <algorithm>

namespace geodesic {

BorderHop::BorderHop(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : index_(index), crossing_(index, memory), on_ring_(memory), owned_(memory),
      ways_(index.numbering.largest_border_size(), memory) {}

void BorderHop::hop_to_parent(uint32_t child, std::span<float> distance) {
    begin(child);
    for (uint32_t i = 0; i < index_.numbering.border_size(parent_); ++i) add(i);
    cross(distance);
}

void BorderHop::hop_to_sibling(uint32_t child, uint32_t sibling, std::span<float> distance) {
    const Numbering& numbering = index_.numbering;
    begin(child);
    for (uint32_t slot = numbering.border_begin[sibling]; slot < numbering.border_begin[sibling + 1]; ++slot)
        add(numbering.overlay_position[slot]);
    cross(distance);
}

void BorderHop::begin(uint32_t child) {
    child_ = child;
    parent_ = index_.numbering.parent[child];
    for (Targets* targets : {&on_ring_, &owned_}) {
        targets->numbers.clear();
        targets->columns.clear();
    }
}

// A vertex of the parent's overlay, unless it is on the border that the hop starts at.
void BorderHop::add(uint32_t position) {
    if (index_.is_on_border(child_, position)) return;
    const OverlayColumn column = index_.overlay_column(parent_, position);
    Targets& targets = column.is_owned ? owned_ : on_ring_;
    targets.numbers.push_back(index_.numbering.overlay_number(parent_, position));
    targets.columns.push_back(column.number);
}

void BorderHop::cross(std::span<float> distance) {
    const uint32_t first = index_.rings.begin[child_];
    const auto border = crossing_.begin(child_, segments_from(index_.rings, first));
    for (uint32_t k = 0; k < border.size(); ++k) border[k] = distance[index_.rings.vertex[first + k]];
    if (!crossing_.finish()) return;
    crossing_.cross_to_ring(on_ring_.columns, ways_.data());
    lower(on_ring_, distance);
    crossing_.cross_to_owned(owned_.columns, ways_.data());
    lower(owned_, distance);
}

void BorderHop::lower(const Targets& targets, std::span<float> distance) const {
    for (size_t i = 0; i < targets.numbers.size(); ++i) {
        float& known = distance[targets.numbers[i]];
        known = std::min(known, ways_[i]);
    }
}

}
