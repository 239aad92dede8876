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

// Lets the crossing begin with the distances from a range of a patch's border. Places that are read outside
// of the range are at infinity, so that no way leads over them.
void begin_crossing(const OverlayIndex& index, uint32_t patch, BorderRange read, BorderRange range,
                    const float* distances, BorderField& field) {
    const auto places =
        field.begin(index.rings, read.first, read.size(), index.quantum[index.numbering.parent[patch]]);
    const auto inside = places.subspan(range.first - read.first, range.size());
    std::fill(places.begin(), inside.begin(), INFINITE);
    std::copy_n(distances, inside.size(), inside.begin());
    std::fill(inside.end(), places.end(), INFINITE);
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

// Goes from either end of what is reached to another vertex of the border, which the outer table has no row
// for: returns the length, and the end.
std::pair<float, uint32_t> go_along(const OverlayIndex& index, uint32_t patch, BorderRange range,
                                    const float* distances, Reached reached, uint32_t overlay_position) {
    const uint32_t parent = index.numbering.parent[patch];
    const uint32_t* positions = index.numbering.overlay_position.data() + index.numbering.border_begin[patch];
    std::pair<float, uint32_t> least{INFINITE, 0};
    if (reached.last < reached.first) return least;
    for (const uint32_t end : {reached.first, reached.last}) {
        const uint32_t from = positions[index.rings.position[range.first + end]];
        const float length =
            distances[end] + index.distance(index.overlay_code(parent, from, overlay_position), parent);
        if (length < least.first) least = {length, end};
    }
    return least;
}

// Crosses from a range of a patch's border to places of another border inside of the same parent.
// overlay_position(k) is the position of place k in the parent's overlay. Vertices that are in both ranges
// keep their distances. Where there are any, a path to a vertex that lies on the border beside the range is
// not looked for: if it were the shortest, those at the end of the range would be the best here, and the
// range is moved then. Returns the place that winners are counted from.
template <class OverlayPosition>
uint32_t cross(const OverlayIndex& index, uint32_t patch, BorderRange range, const float* distances,
               BorderRange to, const OverlayPosition& overlay_position, BorderCrossing& crossing, float* out,
               uint16_t* winners) {
    const Rings& rings = index.rings;
    const BorderRange read = range_read(index, patch, range);
    VertexFinder common({rings.vertex.data() + range.first, range.size()});
    bool has_common = false;
    crossing.reached.clear();
    crossing.rows.clear();
    crossing.beside.clear();
    const auto keep = [&](uint32_t i, float length, uint32_t at) {
        out[i] = length;
        winners[i] = static_cast<uint16_t>(range.first + at - read.first);
    };
    const OuterRows rows = index.outer_rows(patch);
    const size_t first_column = read.first - rings.begin[patch];
    for (uint32_t i = 0; i < to.size(); ++i) {
        if (const uint16_t* const row = rows.of(overlay_position(to.first + i))) {
            crossing.reached.push_back(i);
            crossing.rows.push_back(row + first_column);
        } else if (const uint32_t at = common.find(rings.vertex[to.first + i]); at != NONE) {
            keep(i, distances[at], at);
            has_common = has_common || distances[at] < INFINITE;
        } else {
            keep(i, INFINITE, 0);
            crossing.beside.push_back(i);
        }
    }
    if (!has_common && !crossing.beside.empty()) {
        const Reached reached = reached_of({distances, range.size()});
        for (const uint32_t i : crossing.beside) {
            const auto [length, at] =
                go_along(index, patch, range, distances, reached, overlay_position(to.first + i));
            keep(i, length, at);
        }
    }
    if (crossing.rows.empty()) return read.first;
    begin_crossing(index, patch, read, range, distances, crossing.field);
    if (crossing.field.finish()) {
        crossing.field.cross(crossing.rows, crossing.distances.data(), crossing.winners.data());
        crossing.field.cross_near(crossing.rows, crossing.distances.data());
    } else {
        std::fill_n(crossing.distances.begin(), crossing.rows.size(), INFINITE);
    }
    for (size_t r = 0; r < crossing.reached.size(); ++r) {
        out[crossing.reached[r]] = crossing.distances[r];
        winners[crossing.reached[r]] = crossing.winners[r];
    }
    return read.first;
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
    // A position in the border is the overlay position, too: the overlay of a patch begins with its border.
    const auto position = [this](uint32_t place) { return index_.rings.position[place]; };
    for (size_t b = ranges_.size(); b < ranges.size(); ++b) {
        crossed_[b - 1] = cross(index_, ascent.patches[b - 1], ranges_.back(), distances_of(b - 1), ranges[b],
                                position, crossing, distances_of(b), winners_.data() + b * stride_);
        ranges_.push_back(ranges[b]);
    }
    std::fill_n(distances_of(ranges_.size() - 1) + last_range().size(), SourceCode::BLOCK, INFINITE);
}

uint32_t MeasuredEnd::cross_to(const Ascent& ascent, uint32_t sibling, BorderRange range,
                               BorderCrossing& crossing, std::span<float> out,
                               std::span<uint16_t> winners) const {
    const uint32_t* positions =
        index_.numbering.overlay_position.data() + index_.numbering.border_begin[sibling];
    return cross(
        index_, ascent.last_patch(), last_range(), last_distances(), range,
        [&](uint32_t place) { return positions[index_.rings.position[place]]; }, crossing, out.data(),
        winners.data());
}

}
