#include "src/overlay/msad.h"

#include <algorithm>
#include <limits>

#include "src/overlay/descend.h"
#include "src/overlay/ways_from.h"

namespace geodesic {

namespace {

// The source of each row's way, given the place of the border that the way leads over; NONE where there is no
// way.
void take_sources(std::span<const uint16_t> winners, const SeenSources& seen, uint32_t* source) {
    for (const uint16_t winner : winners)
        *source++ = winner == BorderFromSource::NO_PLACE ? NONE : seen.at(winner);
}

}

OverlayMsad::Scratch::Scratch(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : sweep(index, 1, memory), seen(index, memory),
      near(index, std::max(index.numbering.largest_overlay_size(), index.numbering.largest_inner_size()),
           memory),
      near_sources(index, memory), near_vertices(memory),
      inside(index.numbering.largest_inner_size(), memory),
      source(std::max(index.numbering.largest_overlay_size(), index.numbering.largest_inner_size()), memory),
      winners(source.size(), memory) {}

void OverlayMsad::Scratch::begin() {
    near.reserve();
    near_sources.clear();
}

OverlayMsad::OverlayMsad(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : index_(index), numbering_(index.numbering), ascent_(index, memory), top_(index, memory),
      of_thread_(memory), sources_below_(index.numbering.patch_count(), memory), nearest_source_(memory) {
    set_threads(1);
}

void OverlayMsad::set_threads(uint32_t count) {
    while (of_thread_.size() > count) of_thread_.pop_back();
    while (of_thread_.size() < count) of_thread_.emplace_back(index_, of_thread_.get_allocator().resource());
}

void OverlayMsad::sweep(std::span<const uint32_t> sources, float radius, std::span<float> distance) {
    nearest_source_.resize(numbering_.border_vertex_count());
    top_.begin();
    for (Scratch& scratch : of_thread_) scratch.begin();
    std::ranges::fill(distance, INFINITE);
    std::ranges::fill(sources_below_, 0u);
    source_count_ = static_cast<uint32_t>(sources.size());
    for (uint32_t source : sources) start_from(source, distance);
    for (uint32_t source : sources) look_around(source, distance);
    for (uint32_t p = numbering_.patch_count() - 1; p > 0; --p)
        if (sources_below_[p]) {
            ascend(p, distance);
            sources_below_[numbering_.parent[p]] += sources_below_[p];
        }
    descend_everywhere(index_, top_, std::span(of_thread_),
                       [&](uint32_t patch, Scratch& scratch) { descend(patch, radius, distance, scratch); });
}

void OverlayMsad::start_from(uint32_t source, std::span<float> distance) {
    for_each_way_from(index_, source, [&](uint32_t number, float way) {
        if (way >= distance[number]) return;
        distance[number] = way;
        if (numbering_.is_border(number)) nearest_source_[number] = source;
    });
    ++sources_below_[numbering_.entry(source)];
}

void OverlayMsad::look_around(uint32_t source, std::span<const float> distance) {
    for_each_way_from(index_, source, [&](uint32_t number, float way) {
        if (numbering_.is_border(number)) top_.near_sources.add({source, number, way}, distance[number]);
    });
}

// Hops to the overlay of the parent. The child's border keeps the distances it has.
void OverlayMsad::ascend(uint32_t child, std::span<float> distance) {
    const uint32_t parent = numbering_.parent[child];
    SeenSources& seen = top_.seen;
    seen.see(child, distance.data(), nearest_source_.data());
    if (!ascent_.begin(child, {distance.data()}, seen.segments())) return;
    const std::span<float> outside = ascent_.cross(top_.winners.data());
    take_sources(std::span(top_.winners).first(outside.size()), seen, top_.source.data());
    cross_near(
        child, true, {ascent_.rows(), index_.quantum[parent], outside.data(), top_.source.data()},
        [&](size_t row) { return numbering_.overlay_number(parent, static_cast<uint32_t>(row)); }, top_);
    for (uint32_t i = 0; i < outside.size(); ++i) {
        const uint32_t number = numbering_.overlay_number(parent, i);
        if (outside[i] >= distance[number]) continue;
        distance[number] = outside[i];
        nearest_source_[number] = top_.source[i];
    }
}

// Hops to the inner vertices of a patch. If some sources lie inside of the patch, some distances are known
// already, and the lesser ones count. A patch that contains all sources has its distances already, and a
// patch whose whole border is beyond the radius is skipped. The nearest source of vertices inside a leaf is
// not recorded, because nobody asks for it.
void OverlayMsad::descend(uint32_t patch, float radius, std::span<float> distance, Scratch& scratch) {
    const uint32_t first = numbering_.first_inner(patch), count = numbering_.inner_size(patch);
    if (sources_below_[patch] == source_count_ || count == 0) return;
    SeenSources& seen = scratch.seen;
    seen.see(patch, distance.data(), nearest_source_.data());
    const float nearest = scratch.sweep.begin(patch, distance.data(), seen.segments());
    if (!(nearest < INFINITE) || nearest > radius + index_.near[patch]) return;
    float* const inside = scratch.inside.data();
    if (seen.are_several() && patch < numbering_.first_leaf()) {
        scratch.sweep.cross(inside, scratch.winners.data());
        take_sources(std::span(scratch.winners).first(count), seen, scratch.source.data());
    } else {
        scratch.sweep.cross(inside);
        std::fill_n(scratch.source.data(), count, seen.any());
    }
    cross_near(
        patch, false, {scratch.sweep.inner_rows(), index_.quantum[patch], inside, scratch.source.data()},
        [&](size_t row) { return first + static_cast<uint32_t>(row); }, scratch);
    for (uint32_t i = 0; i < count; ++i) {
        if (inside[i] >= distance[first + i]) continue;
        distance[first + i] = inside[i];
        if (numbering_.is_border(first + i)) nearest_source_[first + i] = scratch.source[i];
    }
}

// Where the vertices of a border have different nearest sources, lets each source that is close to the border
// cross it by itself. Also records which targets are close to their source. vertex_of(row) is the target of a
// row.
template <class VertexOf>
void OverlayMsad::cross_near(uint32_t patch, bool from_inside, const NearCrossing::Targets& targets,
                             const VertexOf& vertex_of, Scratch& scratch) const {
    const auto learn = [&](uint32_t source, size_t row, float distance) {
        if (const uint32_t number = vertex_of(row); numbering_.is_border(number))
            scratch.near_sources.add({source, number, distance}, targets.distance[row]);
    };
    if (!scratch.seen.are_several()) {
        if (!from_inside && patch >= numbering_.first_leaf()) return;
        for (size_t r = 0; r < targets.rows.size(); ++r)
            if (targets.distance[r] < INFINITE) learn(targets.source[r], r, targets.distance[r]);
        return;
    }
    Array<NearVertex>& vertices = scratch.near_vertices;
    vertices.clear();
    top_.near_sources.collect(patch, vertices);
    if (&scratch != &top_) scratch.near_sources.collect(patch, vertices);
    std::erase_if(vertices, [&](const NearVertex& v) {
        return numbering_.is_within(numbering_.entry(v.source), patch) != from_inside;
    });
    scratch.near.cross(patch, vertices, targets, nearest_source_.data(), learn);
}

}
