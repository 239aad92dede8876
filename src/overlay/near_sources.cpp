#include "src/overlay/near_sources.h"

#include <algorithm>

#include "src/overlay/near.h"

namespace geodesic {

NearSources::NearSources(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : index_(index), numbering_(index.numbering), links_(memory), first_link_(memory) {}

void NearSources::clear() {
    longest_reach_ = near_radius(*std::ranges::max_element(index_.longest_segment));
    links_.clear();
    first_link_.assign(numbering_.patch_count(), NONE);
}

void NearSources::add_near(const NearVertex& vertex, float nearest) {
    for (const PatchPosition& at : numbering_.borders_of(vertex.border_vertex)) {
        const float segment = index_.longest_segment[at.patch];
        if (vertex.distance > std::min(near_radius(segment), nearest + 2 * segment)) continue;
        links_.push_back({vertex, first_link_[at.patch]});
        first_link_[at.patch] = static_cast<uint32_t>(links_.size() - 1);
    }
}

void NearSources::collect(uint32_t patch, Array<NearVertex>& vertices) const {
    for (uint32_t l = first_link_[patch]; l != NONE; l = links_[l].next) vertices.push_back(links_[l].vertex);
}

NearCrossing::NearCrossing(const OverlayIndex& index, size_t most_rows, std::pmr::memory_resource* memory)
    : index_(index), numbering_(index.numbering), field_(index, memory), own_(memory),
      way_(most_rows, memory) {}

void NearCrossing::cross_from_one(uint32_t patch, std::span<const NearVertex> vertices, const Ways& ways) {
    const Rings& rings = index_.rings;
    const uint32_t first = rings.begin[patch], places = rings.size(patch);
    const auto border = field_.begin(rings, first, places, ways.targets.quantum);
    for (const NearVertex& v : vertices) own_[v.border_vertex] = std::min(own_[v.border_vertex], v.distance);
    for (uint32_t k = 0; k < places; ++k) border[k] = own_[rings.vertex[first + k]];
    for (const NearVertex& v : vertices) own_[v.border_vertex] = INFINITE;
    const size_t count = ways.distance.size();
    std::fill_n(way_.data(), count, INFINITE);
    if (!field_.finish() || !field_.is_near()) return;
    constexpr float UNKNOWN = -1;
    const float reach = field_.reach();
    for (size_t r = 0; r < count; ++r)
        if (ways.distance[r] <= reach) way_[r] = UNKNOWN;
    field_.cross_near(ways.targets.rows, way_.data());
    for (size_t r = 0; r < count; ++r)
        if (way_[r] == UNKNOWN) way_[r] = INFINITE;
}

}
