#include "src/overlay/sssd/measured_path.h"

#include <algorithm>

namespace geodesic {

namespace {

constexpr uint32_t REACH = Rings::REACH;

// Writes the distances from an end to a range of its first border, which the index holds.
void read_first_range(const OverlayIndex& index, const Ascent& ascent, BorderRange range, float* out) {
    with_ring_distances(index, ascent.vertex, ascent.patches.front(), [&](const auto& distance_to) {
        for (uint32_t i = 0; i < range.size(); ++i) out[i] = distance_to(range.first + i);
    });
}

// Lets the crossing begin with the distances from a range of a patch's border. The kernel reads REACH places
// on each side of a winner. Those outside of the range are at infinity, so that no way leads over them.
// Returns the first of all these places.
uint32_t begin_crossing(const OverlayIndex& index, uint32_t patch, BorderRange range, const float* distances,
                        BorderField& field) {
    const Rings& rings = index.rings;
    const uint32_t first = std::max(range.first, rings.begin[patch] + REACH) - REACH;
    const uint32_t last = std::min(range.last + REACH, rings.begin[patch + 1] - 1);
    const auto places =
        field.begin(rings, first, last - first + 1, index.quantum[index.numbering.parent[patch]]);
    const auto inside = places.subspan(range.first - first, range.size());
    std::fill(places.begin(), inside.begin(), INFINITE);
    std::copy_n(distances, inside.size(), inside.begin());
    std::fill(inside.end(), places.end(), INFINITE);
    return first;
}

// Crosses from a range of a patch's border to places of another border inside of the same parent.
// overlay_position(k) is the position of place k in the parent's overlay.
template <class OverlayPosition>
void cross(const OverlayIndex& index, uint32_t patch, BorderRange range, const float* distances,
           BorderRange to, const OverlayPosition& overlay_position, BorderCrossing& crossing, float* out) {
    const uint32_t first = begin_crossing(index, patch, range, distances, crossing.field);
    if (!crossing.field.finish()) {
        std::fill_n(out, to.size(), INFINITE);
        return;
    }
    const uint16_t* rows =
        index.hops.outer.data() + index.outer_row(patch, 0) + (first - index.rings.begin[patch]);
    crossing.rows.resize(to.size());
    for (uint32_t i = 0; i < to.size(); ++i)
        crossing.rows[i] = rows + size_t{overlay_position(to.first + i)} * index.rings.size(patch);
    crossing.field.cross(crossing.rows, out);
    crossing.field.cross_near(crossing.rows, out);
}

}

MeasuredEnd::MeasuredEnd(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : index_(index), stride_(SourceCode::whole_blocks(index.rings.largest_size()) + SourceCode::BLOCK),
      ranges_(memory), distances_(memory) {
    ranges_.reserve(index.numbering.level_count());
    distances_.resize(index.numbering.level_count() * stride_);
}

void MeasuredEnd::measure(const Ascent& ascent, std::span<const BorderRange> ranges,
                          BorderCrossing& crossing) {
    size_t kept = 0;
    while (kept < ranges_.size() && ranges_[kept].covers(ranges[kept])) ++kept;
    ranges_.resize(kept);
    if (kept == 0) {
        ranges_.push_back(ranges.front());
        read_first_range(index_, ascent, ranges.front(), distances_of(0));
    }
    // A position in the border is the overlay position, too: the overlay of a patch begins with its border.
    const auto position = [this](uint32_t place) { return index_.rings.position[place]; };
    for (size_t b = ranges_.size(); b < ranges.size(); ++b) {
        cross(index_, ascent.patches[b - 1], ranges_.back(), distances_of(b - 1), ranges[b], position,
              crossing, distances_of(b));
        ranges_.push_back(ranges[b]);
    }
    std::fill_n(distances_of(ranges_.size() - 1) + last_range().size(), SourceCode::BLOCK, INFINITE);
}

void MeasuredEnd::cross_to(const Ascent& ascent, uint32_t sibling, BorderRange range,
                           BorderCrossing& crossing, std::span<float> out) const {
    const uint32_t* positions =
        index_.numbering.overlay_position.data() + index_.numbering.border_begin[sibling];
    cross(
        index_, ascent.last_patch(), last_range(), last_distances(), range,
        [&](uint32_t place) { return positions[index_.rings.position[place]]; }, crossing, out.data());
}

}
