#include "src/overlay/fields/ssad.h"

#include <algorithm>

#include "src/overlay/fields/descend.h"

namespace geodesic {

OverlaySsad::OverlaySsad(const OverlayIndex& index, std::pmr::memory_resource* memory, size_t fields,
                         Crossing crossing)
    : index_(index), numbering_(index.numbering), fields_(fields), gaps_(memory), up_(index, memory),
      down_(memory), sources_inside_(memory), is_known_inside_(memory) {
    set_threads(1);
    if (crossing == Crossing::AT_VERTICES) gaps_.resize(index.rings.room_for_places(), Rings::GAP);
}

RingSegments OverlaySsad::segments_of(uint32_t patch) const {
    if (gaps_.empty()) return segments_from(index_.rings, index_.rings.begin[patch]);
    return {gaps_.data(), gaps_.data()};
}

void OverlaySsad::set_threads(uint32_t count) {
    while (down_.size() > count) down_.pop_back();
    while (down_.size() < count) down_.push_back({index_, fields_, down_.get_allocator().resource()});
}

void OverlaySsad::sweep(const Sources& sources, float radius, std::span<float> distances) {
    climb(sources, distances);
    descend_everywhere(numbering_, down_.front(), std::span(down_), [&](uint32_t patch, InnerSweep& sweep) {
        hop_down(patch, sources, radius, distances, sweep);
    });
}

// Fills the distances to the overlays of all patches that contain the source, for each field. All others are
// infinite, but for those that a point knows from what it sees beyond its polygon.
void OverlaySsad::climb(const Sources& sources, std::span<float> distances) {
    std::ranges::fill(distances, INFINITE);
    const auto field = [&](size_t i) { return DistanceField{distances.data() + i, fields_}; };
    for (size_t i = 0; i < fields_; ++i)
        sources.for_each_way(index_, sources.keys[i], [&](uint32_t number, float way) {
            float& known = field(i)[number];
            known = std::min(known, way);
        });
    count_sources(numbering_, sources, sources_inside_);
    mark_known_inside(sources);
    ascend(numbering_, sources_inside_, [&](uint32_t child) {
        for (size_t i = 0; i < fields_; ++i)
            if (numbering_.is_within(sources.innermost_patch(numbering_, sources.keys[i]), child))
                hop_up(child, field(i));
    });
}

// Marks the patches whose inner vertices the leaves of what points see beyond their polygons may have: these
// leaves, and all around them.
void OverlaySsad::mark_known_inside(const Sources& sources) {
    is_known_inside_.assign(numbering_.patch_count(), 0);
    const auto mark = [&](uint32_t leaf) {
        for (uint32_t p = leaf; p != NONE; p = numbering_.parent[p]) is_known_inside_[p] = 1;
    };
    for (const PointWays& point : sources.points)
        for (const auto& [seen, way] : point.beyond)
            if (!numbering_.is_border(seen))
                mark(numbering_.leaf_of(seen));
            else
                for (const PatchPosition& at : numbering_.borders_of(seen)) mark(at.patch);
}

// Hops to the overlay of the parent. The child's border keeps the distances it has.
void OverlaySsad::hop_up(uint32_t child, DistanceField distance) {
    if (up_.begin(child, distance, segments_of(child))) cross_up(distance);
}

void OverlaySsad::hop_to_border(uint32_t child, uint32_t patch, std::span<float> distance) {
    const DistanceField field{distance.data()};
    if (up_.begin_to_border(child, patch, field, segments_of(child))) cross_up(field);
}

void OverlaySsad::cross_up(DistanceField distance) {
    const std::span<const float> ways = up_.cross();
    const std::span<const uint32_t> targets = up_.targets();
    for (size_t r = 0; r < ways.size(); ++r) {
        float& known = distance[targets[r]];
        known = std::min(known, ways[r]);
    }
}

void OverlaySsad::hop_down(uint32_t patch, std::span<float> distance) {
    InnerSweep& sweep = down_.front();
    if (sweep.begin(patch, distance.data(), segments_of(patch), INFINITE))
        sweep.cross_to(distance.data() + numbering_.first_inner(patch));
}

// Hops to the inner vertices of a patch. Their distances from sources inside of the patch are known already,
// and other ways to them may be.
void OverlaySsad::hop_down(uint32_t patch, const Sources& sources, float radius, std::span<float> distances,
                           InnerSweep& sweep) const {
    if (sources_inside_[patch] == fields_) return;
    if (!sweep.begin(patch, distances.data(), segments_of(patch), radius)) return;
    float* const inside = distances.data() + numbering_.first_inner(patch) * fields_;
    if (sources_inside_[patch] == 0 && !is_known_inside_[patch]) {
        sweep.cross_to(inside);
        return;
    }
    const std::span<const float> ways = sweep.cross();
    for (size_t i = 0; i < fields_; ++i)
        if (!numbering_.is_within(sources.innermost_patch(numbering_, sources.keys[i]), patch))
            for (size_t k = i; k < ways.size(); k += fields_) inside[k] = std::min(inside[k], ways[k]);
}

}
