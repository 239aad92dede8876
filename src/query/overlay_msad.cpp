#include "src/query/overlay_msad.h"

#include <algorithm>
#include <limits>

#include "src/query/four_at_a_time.h"

namespace geodesic {

namespace {

constexpr float INFINITE = std::numeric_limits<float>::infinity();

void lower(float& distance, float candidate) { distance = std::min(distance, candidate); }

uint32_t most_rows(const Index& index) {
    uint32_t most = 0;
    for (uint32_t p = 0; p < index.first_leaf(); ++p) most = std::max(most, index.overlay_size(p));
    for (uint32_t p = 0; p < index.patch_count(); ++p) most = std::max(most, index.inner_size(p));
    return most;
}

}

OverlayMsad::OverlayMsad(const Index& index, std::pmr::memory_resource* memory)
    : index_(index), tables_(index.overlay_tables), field_(index, memory), rows_(memory),
      out_(most_rows(index), memory), sources_below_(index.patch_count(), memory) {
    rows_.resize(out_.size());
}

void OverlayMsad::sweep(std::span<const uint32_t> sources, float radius, std::span<float> distance) {
    const DistanceField field{distance.data()};
    std::ranges::fill(distance, INFINITE);
    climb(sources, field);
    // A patch that all sources lie in has its distances already.
    for (uint32_t p = 1; p < index_.patch_count(); ++p)
        if (sources_below_[p] < sources.size()) descend(p, radius, distance);
}

void OverlayMsad::climb(std::span<const uint32_t> sources, DistanceField distance) {
    std::ranges::fill(sources_below_, 0u);
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
    const uint32_t parent = index_.parent[child];
    const auto out = std::span(out_).first(index_.overlay_size(parent));
    hop(child, tables_.quantum[parent], tables_.outer_tables.data() + index_.outer_row(child, 0), distance,
        INFINITE, out);
    for (uint32_t slot = index_.border_begin[child]; slot < index_.border_begin[child + 1]; ++slot)
        out_[index_.overlay_position[slot]] = INFINITE;
    for (uint32_t i = 0; i < out.size(); ++i) lower(distance[index_.overlay_number(parent, i)], out[i]);
}

// To what lies inside, of which some is known where a source is there, too.
void OverlayMsad::descend(uint32_t patch, float radius, std::span<float> distance) {
    const auto inside = distance.subspan(index_.first_inner(patch), index_.inner_size(patch));
    const auto out = sources_below_[patch] == 0 ? inside : std::span(out_).first(inside.size());
    hop(patch, tables_.quantum[patch], tables_.inner_tables.data() + index_.inner_row(patch, 0),
        {distance.data()}, radius, out);
    if (sources_below_[patch] > 0)
        for (size_t i = 0; i < inside.size(); ++i) lower(inside[i], out[i]);
}

// From the border of a patch over rows of its tables, unless all of it is beyond the radius.
void OverlayMsad::hop(uint32_t patch, float quantum, const uint16_t* first_row, DistanceField distance,
                      float radius, std::span<float> out) {
    if (out.empty()) return;
    const Rings& rings = tables_.rings;
    const uint32_t places = rings.size(patch);
    const auto border = field_.begin(rings, rings.begin[patch], places, quantum);
    const uint32_t* vertex = rings.vertex.data() + rings.begin[patch];
    four_at_a_time(border.size(), [&](size_t k) { border[k] = distance[vertex[k]]; });
    if (!field_.finish() || field_.nearest() > radius) {
        std::ranges::fill(out, INFINITE);
        return;
    }
    four_at_a_time(out.size(), [&](size_t i) { rows_[i] = first_row + i * places; });
    field_.cross({rows_.data(), out.size()}, out.data());
}

}
