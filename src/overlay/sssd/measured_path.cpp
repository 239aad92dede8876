#include "src/overlay/sssd/measured_path.h"

#include <algorithm>
#include <utility>

#include "src/overlay/sssd/vertex_finder.h"

namespace geodesic {

namespace {

// The kernel reads Rings::REACH places on each side of a winner. This is what it reads of a border for ways
// over a range.
BorderRange range_read(const OverlayIndex& index, uint32_t patch, BorderRange range) {
    const BorderRange whole = whole_border(index, patch);
    constexpr uint32_t reach = Rings::REACH;
    return {std::max(range.first, whole.first + reach) - reach, std::min(range.last + reach, whole.last)};
}

// What is reached of a patch's border range: the first and the last place, counted from the beginning of the
// range. There is none where the first lies behind the last.
struct Reached {
    uint32_t first, last;
};

Reached reached_of(std::span<const float> distances) {
    const auto is_reached = [](float distance) { return distance < INFINITE; };
    const auto first = std::ranges::find_if(distances, is_reached) - distances.begin();
    const auto behind =
        distances.rend() - std::ranges::find_if(distances.rbegin(), distances.rend(), is_reached);
    if (behind == 0) return {1, 0};
    return {static_cast<uint32_t>(first), static_cast<uint32_t>(behind - 1)};
}

// Goes from either end of what is reached to another vertex of the border: returns the length, and the end.
std::pair<float, uint32_t> go_along(const OverlayIndex& index, uint32_t patch, BorderRange range,
                                    const float* distances, Reached reached, uint32_t overlay_position) {
    const uint32_t parent = index.numbering.parent[patch];
    std::pair<float, uint32_t> least{INFINITE, 0};
    if (reached.last < reached.first) return least;
    for (const uint32_t end : {reached.first, reached.last}) {
        const uint32_t from = index.position_in_parent(patch, range.first + end);
        const float length =
            distances[end] + index.distance(index.overlay_code(parent, from, overlay_position), parent);
        if (length < least.first) least = {length, end};
    }
    return least;
}

// A range that is crossed from, the distances of its places, and what a hop reads around it.
struct CrossedRange {
    uint32_t patch;
    BorderRange range, read;
    const float* distances;
};

CrossedRange range_of(const OverlayIndex& index, uint32_t patch, BorderRange range, const float* distances) {
    return {patch, range, range_read(index, patch, range), distances};
}

// Lets the hop begin with the distances from a range of a patch's border. Places that are read outside of the
// range are at infinity, so that no way leads over them.
void begin_hop(const OverlayIndex& index, const CrossedRange& from, OverlayCrossing& hop) {
    const auto places =
        hop.begin(from.patch, from.read.first, from.read.size(), segments_from(index.rings, from.read.first));
    const auto inside = places.subspan(from.range.first - from.read.first, from.range.size());
    std::fill(places.begin(), inside.begin(), INFINITE);
    std::copy_n(from.distances, inside.size(), inside.begin());
    std::fill(inside.end(), places.end(), INFINITE);
}

// Vertices of the range that is crossed to which lie on the border that is crossed, too, keep the distances
// that they have there, if they are in its range. Where any does, a path to a vertex that lies beside the
// range is not looked for: if it were the shortest, those at the end of the range would be the best here, and
// the range is moved then. To all others, `crossing` has to hop. position(i) is where place i of the range is
// in the parent's overlay, and add(i, position) adds it to what is hopped to.
template <class Position, class Add>
void keep_common(const OverlayIndex& index, const CrossedRange& from, BorderRange to,
                 const Position& position, const Add& add, BorderCrossing& crossing, float* out,
                 uint16_t* winners) {
    const Rings& rings = index.rings;
    VertexFinder common({rings.vertex.data() + from.range.first, from.range.size()});
    const auto keep = [&](uint32_t i, float length, uint32_t at) {
        out[i] = length;
        winners[i] = static_cast<uint16_t>(from.range.first + at - from.read.first);
    };
    bool has_common = false;
    crossing.begin();
    for (uint32_t i = 0; i < to.size(); ++i) {
        if (const uint32_t at_parent = position(i); !index.is_on_border(from.patch, at_parent)) {
            add(i, at_parent);
        } else if (const uint32_t at = common.find(rings.vertex[to.first + i]); at != NONE) {
            keep(i, from.distances[at], at);
            has_common = has_common || from.distances[at] < INFINITE;
        } else {
            keep(i, INFINITE, 0);
            crossing.beside.push_back(i);
        }
    }
    if (has_common || crossing.beside.empty()) return;
    const Reached reached = reached_of({from.distances, from.range.size()});
    for (const uint32_t i : crossing.beside) {
        const auto [length, at] =
            go_along(index, from.patch, from.range, from.distances, reached, position(i));
        keep(i, length, at);
    }
}

// Hops to the targets that `crossing` holds, and writes the distances and the winners of their places. Where
// nothing is reached, distances are infinite, and winners say nothing.
void hop_to_targets(const OverlayIndex& index, const CrossedRange& from, BorderCrossing& crossing, float* out,
                    uint16_t* winners) {
    if (crossing.on_ring.is_empty() && crossing.owned.is_empty()) return;
    begin_hop(index, from, crossing.hop);
    if (!crossing.hop.finish()) {
        for (const HopTargets* targets : {&crossing.on_ring, &crossing.owned})
            for (const uint32_t i : targets->places()) out[i] = INFINITE;
        return;
    }
    const auto take = [&](const HopTargets& targets) {
        const auto places = targets.places();
        for (size_t r = 0; r < places.size(); ++r) {
            out[places[r]] = crossing.distances[r];
            winners[places[r]] = crossing.winners[r];
        }
    };
    float* const distances = crossing.distances.data();
    uint16_t* const over = crossing.winners.data();
    crossing.hop.cross_to_ring(crossing.on_ring.columns(), distances, over);
    take(crossing.on_ring);
    crossing.hop.cross_to_owned(crossing.owned.columns(), distances, over);
    take(crossing.owned);
}

// Crosses from a range of a patch's border to a range of the parent's border.
void cross_up(const OverlayIndex& index, const CrossedRange& from, BorderRange to, BorderCrossing& crossing,
              float* out, uint16_t* winners) {
    const uint32_t first = to.first - index.rings.begin[index.numbering.parent[from.patch]];
    // A position in the border is the overlay position, too: the overlay of a patch begins with its border.
    const uint32_t* const position = index.rings.position.data() + to.first;
    keep_common(
        index, from, to, [&](uint32_t i) { return position[i]; },
        [&](uint32_t i, uint32_t) { crossing.on_ring.add(first + i, i); }, crossing, out, winners);
    hop_to_targets(index, from, crossing, out, winners);
}

// Crosses from a range of a patch's border to a range of a sibling's border.
void cross_over(const OverlayIndex& index, const CrossedRange& from, uint32_t sibling, BorderRange to,
                BorderCrossing& crossing, float* out, uint16_t* winners) {
    const uint32_t parent = index.numbering.parent[from.patch];
    keep_common(
        index, from, to, [&](uint32_t i) { return index.position_in_parent(sibling, to.first + i); },
        [&](uint32_t i, uint32_t position) {
            const OverlayColumn column = index.overlay_column(parent, position);
            (column.is_owned ? crossing.owned : crossing.on_ring).add(column.number, i);
        },
        crossing, out, winners);
    hop_to_targets(index, from, crossing, out, winners);
}

}

MeasuredEnd::MeasuredEnd(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : index_(index), stride_(SourceCode::whole_blocks(index.rings.largest_size()) + SourceCode::BLOCK),
      ranges_(memory), distances_(memory), winners_(memory), crossed_(memory) {
    const size_t borders = index.numbering.level_count();
    ranges_.reserve(borders);
    distances_.resize(borders * stride_);
    winners_.resize(borders * stride_);
    crossed_.resize(borders);
}

void MeasuredEnd::measure(const Ascent& ascent, std::span<const BorderRange> ranges,
                          BorderCrossing& crossing) {
    size_t kept = 0;
    while (kept < ranges_.size() && ranges_[kept].covers(ranges[kept])) ++kept;
    ranges_.resize(kept);
    if (kept == 0) {
        ranges_.push_back(ranges.front());
        const RingRow& row = ascent.first_row;
        for (uint32_t i = 0; i < ranges.front().size(); ++i) distances_[i] = row(ranges.front().first + i);
    }
    for (size_t b = ranges_.size(); b < ranges.size(); ++b) {
        const CrossedRange from =
            range_of(index_, ascent.patches[b - 1], ranges_.back(), distances_of(b - 1));
        cross_up(index_, from, ranges[b], crossing, distances_of(b), winners_.data() + b * stride_);
        crossed_[b - 1] = from.read.first;
        ranges_.push_back(ranges[b]);
    }
    std::fill_n(distances_of(ranges_.size() - 1) + last_range().size(), SourceCode::BLOCK, INFINITE);
}

uint32_t MeasuredEnd::cross_to(const Ascent& ascent, uint32_t sibling, BorderRange range,
                               BorderCrossing& crossing, std::span<float> out,
                               std::span<uint16_t> winners) const {
    const CrossedRange from = range_of(index_, ascent.last_patch(), last_range(), last_distances());
    cross_over(index_, from, sibling, range, crossing, out.data(), winners.data());
    return from.read.first;
}

}
