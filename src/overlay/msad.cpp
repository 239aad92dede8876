#include "src/overlay/msad.h"

#include <algorithm>

#include "src/overlay/ascend.h"
#include "src/overlay/descend.h"

namespace geodesic {

OverlayMsad::Scratch::Scratch(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : sweep(index, 1, memory), border_sources(index, memory),
      near(index, std::max(index.numbering.largest_overlay_size(), index.numbering.largest_inner_size()),
           memory),
      near_sources(index, memory), near_vertices(memory),
      source(std::max(index.numbering.largest_overlay_size(), index.numbering.largest_inner_size()), memory),
      winners(source.size(), memory) {}

void OverlayMsad::Scratch::begin() {
    near.reserve();
    near_sources.clear();
}

// Finds the source of each way of a hop. With of_each, the source of each way is that of its winner.
// Otherwise all ways have any one source: the border has only one, or the targets are internal vertices,
// whose sources nobody reads.
void OverlayMsad::Scratch::find_sources(size_t rows, bool of_each) {
    for (size_t r = 0; r < rows; ++r)
        source[r] = !of_each                                   ? border_sources.any()
                    : winners[r] == BorderFromSource::NO_PLACE ? NONE
                                                               : border_sources.at(winners[r]);
}

OverlayMsad::OverlayMsad(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : index_(index), numbering_(index.numbering), up_(index, memory), top_(index, memory), of_thread_(memory),
      sources_inside_(memory), nearest_source_(memory) {
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
    for (uint32_t source : sources) start_from(source, distance);
    for (uint32_t source : sources) look_around(source, distance);
    count_sources(numbering_, sources, sources_inside_);
    ascend(numbering_, sources_inside_, [&](uint32_t child) { hop_up(child, distance); });
    descend_everywhere(numbering_, top_, std::span(of_thread_),
                       [&](uint32_t patch, Scratch& scratch) { hop_down(patch, radius, distance, scratch); });
}

void OverlayMsad::start_from(uint32_t source, std::span<float> distance) {
    for_each_way_from(index_, source, [&](uint32_t number, float way) {
        if (way >= distance[number]) return;
        distance[number] = way;
        if (numbering_.is_border(number)) nearest_source_[number] = source;
    });
}

void OverlayMsad::look_around(uint32_t source, std::span<const float> distance) {
    for_each_way_from(index_, source, [&](uint32_t number, float way) {
        if (numbering_.is_border(number)) top_.near_sources.add({source, number, way}, distance[number]);
    });
}

// Hops to the overlay of the parent. The child's border keeps the distances it has.
void OverlayMsad::hop_up(uint32_t child, std::span<float> distance) {
    top_.border_sources.read(child, distance.data(), nearest_source_.data());
    if (!up_.begin(child, {distance.data()}, top_.border_sources.segments())) return;
    const std::span<float> found = up_.cross(top_.winners.data());
    top_.find_sources(found.size(), true);
    const NearCrossing::Ways ways{up_.targets(), found, top_.source.data()};
    cross_near(child, true, ways, top_);
    take_lesser(ways, distance);
}

// Hops to the inner vertices of a patch. A patch that contains all sources has their distances already.
void OverlayMsad::hop_down(uint32_t patch, float radius, std::span<float> distance, Scratch& scratch) {
    if (sources_inside_[patch] == sources_inside_[0]) return;
    BorderSources& border_sources = scratch.border_sources;
    border_sources.read(patch, distance.data(), nearest_source_.data());
    if (!scratch.sweep.begin(patch, distance.data(), border_sources.segments(), radius)) return;
    const bool of_each = border_sources.are_several() && patch < numbering_.first_leaf();
    const std::span<float> found =
        of_each ? scratch.sweep.cross(scratch.winners.data()) : scratch.sweep.cross();
    scratch.find_sources(found.size(), of_each);
    const NearCrossing::Ways ways{scratch.sweep.targets(), found, scratch.source.data()};
    cross_near(patch, false, ways, scratch);
    take_lesser(ways, distance);
}

// Where the vertices of a border have different nearest sources, lets each source that is close to the border
// cross it by itself. Also records which targets are close to their source.
void OverlayMsad::cross_near(uint32_t patch, bool from_inside, const NearCrossing::Ways& ways,
                             Scratch& scratch) const {
    const auto learn = [&](uint32_t source, size_t row, float distance) {
        if (const uint32_t number = ways.targets[row]; numbering_.is_border(number))
            scratch.near_sources.add({source, number, distance}, ways.distance[row]);
    };
    if (!scratch.border_sources.are_several()) {
        if (!from_inside && patch >= numbering_.first_leaf()) return;
        for (size_t r = 0; r < ways.distance.size(); ++r)
            if (ways.distance[r] < INFINITE) learn(ways.source[r], r, ways.distance[r]);
        return;
    }
    Array<NearVertex>& vertices = scratch.near_vertices;
    vertices.clear();
    top_.near_sources.collect(patch, vertices);
    if (&scratch != &top_) scratch.near_sources.collect(patch, vertices);
    std::erase_if(vertices, [&](const NearVertex& v) {
        return numbering_.is_within(numbering_.innermost_patch(v.source), patch) != from_inside;
    });
    scratch.near.cross(patch, vertices, ways, nearest_source_.data(), learn);
}

// Keeps the lesser of the known distance and the one that a hop found. The nearest source of vertices inside
// a leaf is not recorded, because nobody asks for it.
void OverlayMsad::take_lesser(const NearCrossing::Ways& ways, std::span<float> distance) {
    for (size_t r = 0; r < ways.distance.size(); ++r) {
        const uint32_t number = ways.targets[r];
        if (ways.distance[r] >= distance[number]) continue;
        distance[number] = ways.distance[r];
        if (numbering_.is_border(number)) nearest_source_[number] = ways.source[r];
    }
}

}
