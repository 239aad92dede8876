#include "src/overlay/sssd/measured_path.h"

#include <algorithm>
#include <utility>

#include "src/overlay/sssd/vertex_finder.h"

namespace geodesic {

namespace {

// The kernel reads Rings::REACH places on each side of a winner. This is what it reads of a border for ways
// over a part.
BorderPart part_read(const OverlayIndex& index, uint32_t patch, const BorderPart& part) {
    const BorderRange whole = whole_border(index.rings, patch);
    constexpr uint32_t reach = Rings::REACH;
    BorderPart read;
    for (const auto& [first, last] : part.ranges())
        read.add({std::max(first, whole.first + reach) - reach, std::min(last + reach, whole.last)});
    return read;
}

// What is reached of a part of a border: the indices of its first and its last place. There is none where the
// first lies behind the last.
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

// A part of a border that is crossed from, which is not empty, and the distances of its places.
struct CrossedPart {
    CrossedPart(const OverlayIndex& index, uint32_t of_patch, const BorderPart& crossed, const float* known)
        : patch(of_patch), ring(index.rings.begin[of_patch]), part(crossed), distances(known) {}

    // A winner is a place of the part, counted from the first one of the ring. A target that no way leads to
    // has the part's first place. If nothing of the part is reached, winners say nothing.
    uint16_t winner(uint32_t place) const { return static_cast<uint16_t>(place - ring); }
    // Kernels tell an index in the part, or in what they read around it, or NO_PLACE.
    uint16_t winner_of_kernel(uint16_t in_read, const BorderPart& read) const {
        if (const BorderRange& first = read.ranges().front(); in_read < first.size()) [[likely]]
            return winner(first.first + in_read);
        return winner(in_read == BorderFromSource::NO_PLACE ? part.place(0) : read.place(in_read));
    }

    uint32_t patch, ring; // and the first place of its ring
    const BorderPart& part;
    const float* distances;
};

// Goes from either end of what is reached to another vertex of the border: returns the length, and the place
// of that end.
std::pair<float, uint32_t> go_along(const OverlayIndex& index, const CrossedPart& crossed, Reached reached,
                                    uint32_t overlay_position) {
    const uint32_t parent = index.numbering.parent[crossed.patch];
    std::pair<float, uint32_t> least{INFINITE, crossed.part.place(0)};
    if (reached.last < reached.first) return least;
    for (const uint32_t end : {reached.first, reached.last}) {
        const uint32_t place = crossed.part.place(end);
        const uint32_t from = index.position_in_parent(crossed.patch, place);
        const float length = crossed.distances[end] +
                             index.distance(index.overlay_code(parent, from, overlay_position), parent);
        if (length < least.first) least = {length, place};
    }
    return least;
}

// Lets the hop begin with the distances of what is crossed. Places that are read outside of that are at
// infinity, so that no way leads over them.
void begin_hop(const CrossedPart& from, const BorderPart& read, OverlayCrossing& hop) {
    const auto places = hop.begin(from.patch, read);
    std::ranges::fill(places, INFINITE);
    const float* distances = from.distances;
    for (const BorderRange& range : from.part.ranges()) {
        std::copy_n(distances, range.size(), places.data() + read.index(range.first));
        distances += range.size();
    }
}

// Handles the vertices of `to` by where they lie:
// - In the part `from` of the border that is crossed: they keep the distances that they have there.
// - On that border, beside the part: if any vertex of its chains has kept a finite distance, they are left at
//   infinity. A best path that led to one of them would cross at an end of the part, and the part would be
//   moved there. If none has, they are reached along the border, from the first or the last reached place of
//   the chains in `from`.
// - Not on that border: a hop has to reach them, and add(place, position, i) is called for each, the i-th of
//   `to`.
// position(place) is the position of a place of `to` in the overlay of the parent.
template <class Position, class Add>
void keep_common(const OverlayIndex& index, const CrossedPart& from, const BorderPart& to,
                 const Position& position, const Add& add, BorderCrossing& crossing, float* out,
                 uint16_t* winners) {
    VertexFinder common(index.rings, from.part);
    const auto keep = [&](uint32_t i, float length, uint32_t place) {
        out[i] = length;
        winners[i] = from.winner(place);
    };
    const uint32_t of_chains = places_of_chains(index.rings, from.patch, from.part);
    bool has_common = false;
    crossing.begin();
    uint32_t i = 0;
    to.for_each_place([&](uint32_t place) {
        if (const uint32_t at_parent = position(place); !index.is_on_border(from.patch, at_parent)) {
            add(place, at_parent, i);
        } else if (const auto at = common.find(index.rings.vertex[place]); at.index != NONE) {
            keep(i, from.distances[at.index], at.place);
            has_common = has_common || (at.index < of_chains && from.distances[at.index] < INFINITE);
        } else {
            keep(i, INFINITE, from.part.place(0));
            crossing.beside.push_back(i);
        }
        ++i;
    });
    if (has_common || crossing.beside.empty()) return;
    const Reached reached = reached_of({from.distances, of_chains});
    for (const uint32_t beside : crossing.beside) {
        const auto [length, at] = go_along(index, from, reached, position(to.place(beside)));
        keep(beside, length, at);
    }
}

// Takes what a hop has found for the targets. Its winners are indices in `read`.
void take_found(const CrossedPart& from, const BorderPart& read, const HopTargets& targets,
                const BorderCrossing& crossing, float* out, uint16_t* winners) {
    const auto places = targets.places();
    for (size_t r = 0; r < places.size(); ++r) {
        out[places[r]] = crossing.distances[r];
        winners[places[r]] = from.winner_of_kernel(crossing.winners[r], read);
    }
}

// Lets a hop that has begun, with what it reads of the border, cross to all targets.
template <class Hop>
void cross_to_targets(Hop& hop, const CrossedPart& from, const BorderPart& read, BorderCrossing& crossing,
                      float* out, uint16_t* winners) {
    hop.cross_to_ring(crossing.on_ring.columns(), crossing.distances.data(), crossing.winners.data());
    take_found(from, read, crossing.on_ring, crossing, out, winners);
    hop.cross_to_owned(crossing.owned.columns(), crossing.distances.data(), crossing.winners.data());
    take_found(from, read, crossing.owned, crossing, out, winners);
}

// Hops to the targets that `crossing` holds, and writes the distances and the winners of their places. Where
// nothing is reached, distances are infinite, and winners say nothing.
void hop_to_targets(const OverlayIndex& index, const CrossedPart& from, BorderCrossing& crossing, float* out,
                    uint16_t* winners) {
    const size_t columns = crossing.on_ring.columns().size() + crossing.owned.columns().size();
    if (columns == 0) return;
    const bool has_rows = crossing.owned.is_empty() || !index.is_large[index.numbering.parent[from.patch]];
    if (has_rows && FewCrossing::is_quicker(from.part, columns)) {
        crossing.few.begin(from.patch, from.part, from.distances);
        return cross_to_targets(crossing.few, from, from.part, crossing, out, winners);
    }
    const BorderPart read = part_read(index, from.patch, from.part);
    begin_hop(from, read, crossing.hop);
    if (!crossing.hop.finish()) {
        for (const HopTargets* targets : {&crossing.on_ring, &crossing.owned})
            for (const uint32_t i : targets->places()) out[i] = INFINITE;
        return;
    }
    cross_to_targets(crossing.hop, from, read, crossing, out, winners);
}

// Crosses from a part of a patch's border to a part of the parent's border.
void cross_up(const OverlayIndex& index, const CrossedPart& from, const BorderPart& to,
              BorderCrossing& crossing, float* out, uint16_t* winners) {
    const uint32_t ring = index.rings.begin[index.numbering.parent[from.patch]];
    // A position in the border is the overlay position, too: the overlay of a patch begins with its border.
    keep_common(
        index, from, to, [&](uint32_t place) { return index.rings.position[place]; },
        [&](uint32_t place, uint32_t, uint32_t i) { crossing.on_ring.add(place - ring, i); }, crossing, out,
        winners);
    hop_to_targets(index, from, crossing, out, winners);
}

// Crosses from a part of a patch's border to a part of a sibling's border.
void cross_over(const OverlayIndex& index, const CrossedPart& from, uint32_t sibling, const BorderPart& to,
                BorderCrossing& crossing, float* out, uint16_t* winners) {
    const uint32_t parent = index.numbering.parent[from.patch];
    keep_common(
        index, from, to, [&](uint32_t place) { return index.position_in_parent(sibling, place); },
        [&](uint32_t, uint32_t position, uint32_t i) {
            const OverlayColumn column = index.overlay_column(parent, position);
            (column.is_owned ? crossing.owned : crossing.on_ring).add(column.number, i);
        },
        crossing, out, winners);
    hop_to_targets(index, from, crossing, out, winners);
}

}

MeasuredEnd::MeasuredEnd(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : index_(index), stride_(index.rings.room_for_places()), parts_(memory), distances_(memory),
      winners_(memory) {
    const size_t borders = index.numbering.level_count();
    parts_.reserve(borders);
    distances_.resize(borders * stride_);
    winners_.resize(borders * stride_);
}

void MeasuredEnd::measure(const Ascent& ascent, std::span<const BorderPart> parts, BorderCrossing& crossing) {
    size_t kept = 0;
    while (kept < parts_.size() && parts_[kept].covers(parts[kept])) ++kept;
    parts_.resize(kept);
    if (kept == 0) {
        parts_.push_back(parts.front());
        float* distance = distances_of(0);
        parts.front().for_each_place([&](uint32_t place) { *distance++ = ascent.first_row(place); });
    }
    for (size_t b = parts_.size(); b < parts.size(); ++b) {
        const CrossedPart from(index_, ascent.patches[b - 1], parts_.back(), distances_of(b - 1));
        cross_up(index_, from, parts[b], crossing, distances_of(b), winners_.data() + b * stride_);
        parts_.push_back(parts[b]);
    }
    std::fill_n(distances_of(parts_.size() - 1) + last_part().size(), SourceCode::BLOCK, INFINITE);
}

void MeasuredEnd::cross_to(const Ascent& ascent, uint32_t sibling, const BorderPart& part,
                           BorderCrossing& crossing, std::span<float> out,
                           std::span<uint16_t> winners) const {
    const CrossedPart from(index_, ascent.last_patch(), last_part(), last_distances());
    cross_over(index_, from, sibling, part, crossing, out.data(), winners.data());
}

}
