#include "src/query/overlay_msad.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <system_error>
#include <thread>
#include <vector>

#include "src/query/four_at_a_time.h"

namespace geodesic {

namespace {

constexpr float INFINITE = std::numeric_limits<float>::infinity();

void lower(float& distance, float candidate) { distance = std::min(distance, candidate); }

}

OverlayMsad::OverlayMsad(const Index& index, std::pmr::memory_resource* memory)
    : index_(index), tables_(index.overlay_tables), ascent_(index, memory), rows_(memory), outside_(memory),
      descents_(memory), sources_below_(index.patch_count(), memory) {
    uint32_t most = 0;
    for (uint32_t p = 0; p < index.first_leaf(); ++p) most = std::max(most, index.overlay_size(p));
    rows_.resize(most);
    outside_.resize(most);
    set_threads(1);
}

void OverlayMsad::set_threads(uint32_t count) {
    while (descents_.size() > count) descents_.pop_back();
    while (descents_.size() < count)
        descents_.push_back({index_, index_.largest_inner_size(), descents_.get_allocator().resource()});
}

void OverlayMsad::sweep(std::span<const uint32_t> sources, float radius, std::span<float> distance) {
    const DistanceField field{distance.data()};
    std::ranges::fill(distance, INFINITE);
    climb(sources, field);
    descend_everywhere(radius, distance);
}

void OverlayMsad::sweep_borders(uint32_t source, uint32_t level, std::span<float> distance) {
    std::ranges::fill(distance, INFINITE);
    climb({&source, 1}, {distance.data()});
    for (uint32_t p = 1; p < index_.level_begin[level]; ++p)
        descend(p, INFINITE, distance, descents_.front());
}

void OverlayMsad::climb(std::span<const uint32_t> sources, DistanceField distance) {
    std::ranges::fill(sources_below_, 0u);
    source_count_ = static_cast<uint32_t>(sources.size());
    for (uint32_t source : sources) start_from(source, distance);
    for (uint32_t p = index_.patch_count() - 1; p > 0; --p)
        if (sources_below_[p]) {
            ascend(p, distance);
            sources_below_[index_.parent[p]] += sources_below_[p];
        }
}

// To everything inside of the patch that the source lies in, and to its border.
void OverlayMsad::start_from(uint32_t source, DistanceField distance) {
    const uint32_t patch = index_.entry(source), first = index_.first_inner(patch), own = source - first;
    const auto border = index_.border_of(patch);
    lower(distance[source], 0);
    if (index_.is_border(source)) {
        const auto position = static_cast<uint32_t>(border.size()) + own;
        for (uint32_t i = 0; i < index_.overlay_size(patch); ++i)
            lower(distance[index_.overlay_number(patch, i)],
                  tables_.distance(index_.overlay_code(patch, i, position), patch));
    } else {
        for (uint32_t i = 0; i < border.size(); ++i)
            lower(distance[border[i]], tables_.distance(index_.crossing_code(patch, i, own), patch));
        for (uint32_t i = 0; i < index_.internal_size(patch); ++i)
            if (i != own)
                lower(distance[first + i],
                      tables_.distance(tables_.internal_tables[index_.internal_place(patch, own, i)], patch));
    }
    ++sources_below_[patch];
}

// To the overlay of the parent. The child's border keeps its own distances.
void OverlayMsad::ascend(uint32_t child, DistanceField distance) {
    const Rings& rings = tables_.rings;
    const uint32_t parent = index_.parent[child], places = rings.size(child);
    const auto border = ascent_.begin(rings, rings.begin[child], places, tables_.quantum[parent]);
    const uint32_t* vertex = rings.vertex.data() + rings.begin[child];
    for (uint32_t k = 0; k < places; ++k) border[k] = distance[vertex[k]];
    if (!ascent_.finish()) return;
    const auto outside = std::span(outside_).first(index_.overlay_size(parent));
    const uint16_t* first_row = tables_.outer_tables.data() + index_.outer_row(child, 0);
    for (size_t i = 0; i < outside.size(); ++i) rows_[i] = first_row + i * places;
    ascent_.cross({rows_.data(), outside.size()}, outside.data());
    ascent_.cross_near({rows_.data(), outside.size()}, outside.data());
    for (uint32_t slot = index_.border_begin[child]; slot < index_.border_begin[child + 1]; ++slot)
        outside[index_.overlay_position[slot]] = INFINITE;
    for (uint32_t i = 0; i < outside.size(); ++i)
        lower(distance[index_.overlay_number(parent, i)], outside[i]);
}

// Parents before their children: the patches of a level that is fine enough are shared out to the threads,
// each with all that lies inside.
void OverlayMsad::descend_everywhere(float radius, std::span<float> distance) {
    constexpr size_t PATCHES_PER_THREAD = 3;
    uint32_t level = 1;
    if (descents_.size() > 1)
        while (level < index_.level_count() && index_.level_begin[level + 1] - index_.level_begin[level] <
                                                   PATCHES_PER_THREAD * descents_.size())
            ++level;
    for (uint32_t p = 1; p < index_.level_begin[level]; ++p) descend(p, radius, distance, descents_.front());
    std::atomic<uint32_t> next = index_.level_begin[level];
    const auto work = [&](Descent& descent) {
        for (uint32_t p; (p = next++) < index_.level_begin[level + 1];)
            descend_into(p, radius, distance, descent);
    };
    std::vector<std::jthread> threads;
    try {
        for (size_t t = 1; t < descents_.size(); ++t)
            threads.emplace_back([&work, &descent = descents_[t]] { work(descent); });
    } catch (const std::system_error&) { // no more threads: those that there are do all
    }
    work(descents_.front());
}

// To all that lies inside of a patch and of its descendants.
void OverlayMsad::descend_into(uint32_t patch, float radius, std::span<float> distance,
                               Descent& descent) const {
    uint32_t first = patch, end = patch + 1;
    for (;;) {
        for (uint32_t p = first; p < end; ++p) descend(p, radius, distance, descent);
        if (first >= index_.first_leaf()) return;
        first = index_.child_begin[first];
        end = index_.child_begin[end];
    }
}

// To what lies inside, of which some is known where a source is there, too. A patch that all sources lie in
// has its distances already; one that is all beyond the radius keeps its infinite ones.
void OverlayMsad::descend(uint32_t patch, float radius, std::span<float> distance, Descent& descent) const {
    if (sources_below_[patch] == source_count_ || index_.inner_size(patch) == 0) return;
    const float nearest = descent.sweep.see(patch, distance.data());
    if (!(nearest < INFINITE) || nearest > radius) return;
    const auto inside = distance.subspan(index_.first_inner(patch), index_.inner_size(patch));
    if (sources_below_[patch] == 0) return descent.sweep.cross(inside.data());
    descent.sweep.cross(descent.inside.data());
    for (size_t i = 0; i < inside.size(); ++i) lower(inside[i], descent.inside[i]);
}

}
