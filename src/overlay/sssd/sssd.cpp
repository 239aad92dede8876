#include "src/overlay/sssd/sssd.h"

#include <algorithm>
#include <array>

#include "src/overlay/unfolding.h"

namespace geodesic {

namespace {

constexpr uint32_t REACH = Rings::REACH;

// Returns the first level whose borders have few places on average and are all labelled whole.
uint32_t first_level_of_short_borders(const OverlayIndex& index) {
    constexpr uint32_t FEW = 128;
    const auto& begin = index.rings.begin;
    for (uint32_t level = 1; level < index.numbering.level_count(); ++level) {
        const uint32_t first = index.numbering.level_begin[level],
                       end = index.numbering.level_begin[level + 1];
        bool whole = begin[end] - begin[first] <= FEW * (end - first);
        for (uint32_t p = first; p < end; ++p) whole = whole && index.is_labelled_whole(p);
        if (whole) return level;
    }
    return index.numbering.level_count();
}

// Returns the lowest patch that two patches lie in. A parent has a smaller number than its children.
uint32_t lowest_common_patch(const Numbering& numbering, uint32_t a, uint32_t b) {
    while (a != b) (a > b ? a : b) = numbering.parent[std::max(a, b)];
    return a;
}

// Returns the child of `top` that a patch inside of `top` lies in.
uint32_t child_around(const Numbering& numbering, uint32_t top, uint32_t patch) {
    while (numbering.parent[patch] != top) patch = numbering.parent[patch];
    return patch;
}

// Distances that are known of vertices, for each place of all rings.
struct KnownDistances {
    std::span<const float> of_vertex;
    const uint32_t* vertex;

    float operator()(size_t place) const { return of_vertex[vertex[place]]; }
};

// Returns the shortest path over the border of a patch, given the distances from both ends to its places.
template <class From, class To>
float shortest_path_over(const OverlayIndex& index, uint32_t patch, From from, To to) {
    const Rings& rings = index.rings;
    const size_t first = rings.begin[patch], end = rings.begin[patch + 1];
    float shortest = INFINITE;
    size_t nearest = 0;
    for (size_t k = first; k < end; ++k) {
        const float sum = from(k) + to(k);
        if (!rings.is_own[k] || !(sum < shortest)) continue;
        shortest = sum;
        nearest = k;
    }
    if (!(shortest < INFINITE)) return INFINITE;
    if (shortest > index.near[patch]) return straightened(rings, nearest, from, to);
    for (size_t k = first + REACH; k + REACH < end; ++k)
        shortest = std::min(shortest, straightened(rings, k, from, to));
    return shortest;
}

}

OverlaySssd::OverlaySssd(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : index_(index), numbering_(index.numbering), prepared_level_(first_level_of_short_borders(index)),
      crossing_(index, memory), from_(index, memory), to_(index, memory), samples_(index, memory),
      from_distances_(index.rings.largest_size(), memory) {}

void OverlaySssd::End::climb(const OverlayIndex& index, uint32_t vertex, uint32_t top) {
    geodesic::climb(index, vertex, top, ascent);
    ranges.begin(ascent);
    measured.begin();
}

struct OverlaySssd::Climber {
    OverlaySssd& search;
    End& end;
    uint32_t patch; // Where the ends meet: its border is crossed to from that of a sibling.

    void read_samples() const {
        cross_samples(search.index_, end.ascent, patch, search.crossing_, search.samples_);
    }

    // Finds the ranges of paths to a sample and to its two neighbours.
    bool find_ranges(uint32_t place) const {
        const Samples& samples = search.index_.samples;
        const uint32_t* sample = samples.sample_of_place.data() + samples.rings.begin[patch];
        const auto& winner = search.samples_.winner;
        const std::array<uint16_t, 3> winners{winner[sample[place - 1]], winner[sample[place]],
                                              winner[sample[place + 1]]};
        return end.ranges.find(end.ascent, range_of_winners(winners));
    }
    bool find_ranges_within(float reach) const {
        return end.ranges.find(end.ascent, samples_within(search.index_, end.ascent, reach));
    }
    void measure(BorderRange range, Straighten straighten, std::span<float> out) const {
        end.measured.measure(end.ascent, end.ranges.ranges(), straighten, search.crossing_);
        end.measured.cross_to(end.ascent, patch, range, straighten, search.crossing_, out);
    }
};

// distance_to(place) is the distance to a place of the patch's ring. No border lies before this one, so that
// there are no ranges to find.
template <class DistanceTo>
struct OverlaySssd::KnownVertex {
    OverlaySssd& search;
    uint32_t patch;
    DistanceTo distance_to;

    void read_samples() const {
        search.samples_.distance.resize(search.index_.samples.of(patch).size());
        geodesic::read_samples(search.index_, patch, distance_to, search.samples_.distance);
    }
    bool find_ranges(uint32_t) const { return true; }
    bool find_ranges_within(float) const { return true; }
    void measure(BorderRange range, Straighten, std::span<float> out) const {
        for (uint32_t i = 0; i < range.size(); ++i) out[i] = distance_to(range.first + i);
    }
};

float OverlaySssd::distance(uint32_t low, uint32_t high) {
    const uint32_t low_entry = numbering_.entry(low), high_entry = numbering_.entry(high);
    const uint32_t top = lowest_common_patch(numbering_, low_entry, high_entry);
    const bool low_climbs = low_entry != top, high_climbs = high_entry != top;
    if (!low_climbs && !high_climbs) return distance_inside(top, low, high);
    const uint32_t climber = high_climbs ? high : low, other = high_climbs ? low : high;
    const uint32_t patch = child_around(numbering_, top, numbering_.entry(climber));
    if (low_climbs && high_climbs) {
        to_.climb(index_, climber, top);
        from_.climb(index_, other, top);
        return meet(Climber{*this, from_, patch});
    }
    if (const float d = distance_to_border(patch, other, climber); d < INFINITE) return d;
    to_.climb(index_, climber, top);
    const uint32_t position = numbering_.position_at_owner(other);
    return meet(KnownVertex<RingRow>{*this,
                                     patch,
                                     {index_.hops.outer.data() + index_.outer_row(patch, position),
                                      index_.rings.begin[patch], index_.quantum[top]}});
}

// Returns the distance between two vertices of which a patch is the innermost one around both.
float OverlaySssd::distance_inside(uint32_t patch, uint32_t low, uint32_t high) const {
    if (patch < numbering_.first_leaf())
        return index_.distance(
            index_.overlay_code(patch, numbering_.position_at_owner(low), numbering_.position_at_owner(high)),
            patch);
    const uint32_t first = numbering_.first_internal(patch);
    return index_.distance(index_.internal_code(patch, low - first, high - first), patch);
}

// Returns the distance between a vertex on the border of a patch and one inside of the patch if the index
// holds it, and infinity otherwise.
float OverlaySssd::distance_to_border(uint32_t patch, uint32_t border_vertex, uint32_t vertex) const {
    if (patch != numbering_.entry(vertex) && !index_.is_labelled_whole(patch)) return INFINITE;
    for (const BorderPlace& at : numbering_.places_of(border_vertex)) {
        if (at.patch != patch) continue;
        const uint32_t own = index_.rings.place_of_slot[numbering_.border_begin[patch] + at.position];
        return with_ring_distances(index_, vertex, patch, [&](const auto& distance_to) {
            return distance_to(index_.rings.begin[patch] + own);
        });
    }
    return INFINITE;
}

float OverlaySssd::distance_from(uint32_t source, std::span<const float> known, uint32_t target) {
    const uint32_t entry = numbering_.entry(target), source_entry = numbering_.entry(source);
    if (entry < numbering_.level_begin[prepared_level_]) return known[target];
    uint32_t patch = entry;
    while (patch >= numbering_.level_begin[prepared_level_ + 1]) patch = numbering_.parent[patch];
    if (!numbering_.is_within(source_entry, patch)) return distance_over(patch, known, target);
    const uint32_t top = lowest_common_patch(numbering_, source_entry, entry);
    if (entry == top) return known[target];
    const uint32_t child = child_around(numbering_, top, entry);
    if (source_entry == top)
        if (const float d = distance_to_border(child, source, target); d < INFINITE) return d;
    to_.climb(index_, target, top);
    return meet(KnownVertex<KnownDistances>{*this, child, {known, index_.rings.vertex.data()}});
}

// Returns the distance of a target inside of a patch whose border is labelled whole from a source outside.
float OverlaySssd::distance_over(uint32_t patch, std::span<const float> known, uint32_t target) const {
    const KnownDistances from{known, index_.rings.vertex.data()};
    return with_ring_distances(index_, target, patch,
                               [&](const auto& to) { return shortest_path_over(index_, patch, from, to); });
}

// Measures each candidate on the border where `to_` ends its climb. If the shortest path is so short that the
// straight way may pass anywhere near the ends, measures once more, over all that lies within its length.
template <class From>
float OverlaySssd::meet(const From& from) {
    const uint32_t patch = to_.ascent.last_patch();
    from.read_samples();
    float shortest = INFINITE;
    for (const uint32_t place :
         find_candidates(index_, patch, samples_.distance, to_.ascent.sample_distances))
        if (from.find_ranges(place) && to_.ranges.find(to_.ascent, {place, place}))
            shortest = std::min(shortest, measure(from, Straighten::BESIDE_LEAST_SUM));
    if (!(shortest <= index_.near[patch])) return shortest;
    const float reach = shortest + 2 * index_.samples.longest_gap[patch];
    if (from.find_ranges_within(reach) &&
        to_.ranges.find(to_.ascent, samples_within(index_, to_.ascent, reach)))
        shortest = std::min(shortest, measure(from, Straighten::EVERYWHERE));
    return shortest;
}

// Measures the path over the ranges that both ends have found.
template <class From>
float OverlaySssd::measure(const From& from, Straighten straighten) {
    to_.measured.measure(to_.ascent, to_.ranges.ranges(), straighten, crossing_);
    const BorderRange range = to_.measured.last_range();
    const auto from_distances = std::span(from_distances_).first(range.size());
    from.measure(range, straighten, from_distances);
    return shortest_path(index_.rings, range, from_distances, to_.measured.last_distances(), straighten);
}

}
