#include "src/overlay/ssad.h"

#include <algorithm>
#include <limits>

#include "src/overlay/descend.h"
#include "src/overlay/ways_from.h"

namespace geodesic {

OverlaySsad::OverlaySsad(const OverlayIndex& index, std::pmr::memory_resource* memory, Crossing crossing)
    : index_(index), numbering_(index.numbering), gaps_(memory), ascent_(index, memory), descents_(memory),
      is_around_source_(index.numbering.patch_count(), memory) {
    set_threads(1);
    if (crossing == Crossing::AT_VERTICES)
        gaps_.resize(SourceCode::whole_blocks(index.rings.largest_size()) + SourceCode::BLOCK, Rings::GAP);
}

RingSegments OverlaySsad::segments_of(uint32_t patch) const {
    if (gaps_.empty()) return segments_from(index_.rings, index_.rings.begin[patch]);
    return {gaps_.data(), gaps_.data()};
}

void OverlaySsad::set_threads(uint32_t count) {
    while (descents_.size() > count) descents_.pop_back();
    while (descents_.size() < count) descents_.push_back({index_, 1, descents_.get_allocator().resource()});
}

void OverlaySsad::sweep(uint32_t source, float radius, std::span<float> distance) {
    std::ranges::fill(distance, INFINITE);
    climb(source, {distance.data()});
    const std::span sweeps(descents_);
    descend_everywhere(index_, sweeps.front(), sweeps,
                       [&](uint32_t patch, InnerSweep& sweep) { descend(patch, radius, distance, sweep); });
}

void OverlaySsad::sweep_borders(uint32_t source, uint32_t level, std::span<float> distance) {
    std::ranges::fill(distance, INFINITE);
    climb(source, {distance.data()});
    for (uint32_t p = 1; p < numbering_.level_begin[level]; ++p)
        descend(p, INFINITE, distance, descents_.front());
}

void OverlaySsad::climb(uint32_t source, DistanceField distance) {
    std::ranges::fill(is_around_source_, uint8_t{0});
    for_each_way_from(index_, source, [&](uint32_t number, float way) {
        distance[number] = std::min(distance[number], way);
    });
    for (uint32_t p = numbering_.entry(source); p != NONE; p = numbering_.parent[p]) {
        is_around_source_[p] = 1;
        if (p != 0) ascend(p, distance);
    }
}

// Hops to the overlay of the parent. The child's border keeps the distances it has.
void OverlaySsad::ascend(uint32_t child, DistanceField distance) {
    if (!ascent_.begin(child, distance, segments_of(child))) return;
    const std::span<const float> outside = ascent_.cross();
    for (uint32_t i = 0; i < outside.size(); ++i) {
        float& known = distance[numbering_.overlay_number(numbering_.parent[child], i)];
        known = std::min(known, outside[i]);
    }
}

// Hops to the inner vertices of a patch. A patch that contains the source has these distances already. A
// patch whose whole border is beyond the radius is skipped.
void OverlaySsad::descend(uint32_t patch, float radius, std::span<float> distance, InnerSweep& sweep) const {
    if (is_around_source_[patch] || numbering_.inner_size(patch) == 0) return;
    const float nearest = sweep.begin(patch, distance.data(), segments_of(patch));
    if (nearest < INFINITE && nearest <= radius + index_.near[patch])
        sweep.cross(distance.data() + numbering_.first_inner(patch));
}

}
