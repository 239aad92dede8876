#include "src/overlay/sssd/sssd.h"

#include <algorithm>
#include <array>

#include "src/overlay/kernels/dispatch.h"
#include "src/overlay/ring_segments.h"

namespace geodesic {

namespace {

// Borders that have no more pairs of places than this are crossed as a whole: that takes less time than
// finding the part of them that a path may cross.
constexpr size_t FEW_PAIRS = size_t{1} << 14;

// Returns the first level whose borders have few places on average and are all labelled whole, or the level
// of the leaves if there is none.
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

// Whether the borders of an ascent are so short that all of each may be crossed.
bool has_few_pairs(const Rings& rings, const Ascent& ascent) {
    for (size_t b = 1; b < ascent.patches.size(); ++b)
        if (size_t{rings.size(ascent.patches[b - 1])} * rings.size(ascent.patches[b]) > FEW_PAIRS)
            return false;
    return true;
}

// Distances by vertex number, read by place.
struct KnownDistances {
    std::span<const float> of_vertex;
    const uint32_t* vertex;

    float operator()(size_t place) const { return of_vertex[vertex[place]]; }
};

}

OverlaySssd::OverlaySssd(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : index_(index), numbering_(index.numbering), prepared_level_(first_level_of_short_borders(index)),
      crossing_(index, memory), from_(index, memory), to_(index, memory), samples_(index, memory),
      from_distances_(SourceCode::whole_blocks(index.rings.largest_size()) + SourceCode::BLOCK, memory) {}

void OverlaySssd::End::climb(const OverlayIndex& index, uint32_t vertex, uint32_t top) {
    geodesic::climb(index, vertex, top, ascent);
    measured.begin();
}

void OverlaySssd::End::read_samples(const OverlayIndex& index, BorderCrossing& crossing) {
    geodesic::read_samples(index, crossing, ascent);
    ranges.begin(ascent);
}

struct OverlaySssd::Climber {
    OverlaySssd& search;
    End& end;

    void read_samples() const {
        end.read_samples(search.index_, search.crossing_);
        hop_to_sibling(search.index_, end.ascent.last_patch(), end.ascent.sample_distances,
                       search.meeting_patch(), search.crossing_, search.samples_);
    }

    // Finds the ranges of paths to a sample and to its two neighbours.
    bool find_ranges(uint32_t place) const {
        const Samples& samples = search.index_.pairs.samples;
        const uint32_t* sample = samples.sample_of_place.data() + samples.rings.begin[search.meeting_patch()];
        const auto& winner = search.samples_.winner;
        const std::array<uint16_t, 3> winners{winner[sample[place - 1]], winner[sample[place]],
                                              winner[sample[place + 1]]};
        return end.ranges.find(end.ascent, range_of_winners(winners));
    }
    bool find_ranges_within(float reach) const {
        return end.ranges.find(end.ascent, samples_within(search.index_, end.ascent, reach));
    }
    // Whether the border that the other end climbs to is to be crossed as a whole from that of this end.
    bool crosses_whole() const {
        const Rings& rings = search.index_.rings;
        return has_few_pairs(rings, end.ascent) &&
               size_t{rings.size(search.meeting_patch())} * rings.size(end.ascent.last_patch()) <= FEW_PAIRS;
    }
    bool take_whole() const { return end.ranges.take_whole(end.ascent); }
    void measure(BorderRange range, std::span<float> out) const {
        end.measured.measure(end.ascent, end.ranges.ranges(), search.crossing_);
        end.measured.cross_to(end.ascent, search.meeting_patch(), range, search.crossing_, out);
    }
};

// distance_to(place) is the distance to a place of the ring where the ends meet. No border lies before this
// one, so that there are no ranges to find.
template <class DistanceTo>
struct OverlaySssd::KnownVertex {
    OverlaySssd& search;
    DistanceTo distance_to;

    void read_samples() const {
        const uint32_t patch = search.meeting_patch();
        search.samples_.distance.resize(search.index_.pairs.samples.of(patch).size());
        geodesic::read_samples(search.index_, patch, distance_to, search.samples_.distance);
    }
    bool find_ranges(uint32_t) const { return true; }
    bool find_ranges_within(float) const { return true; }
    bool crosses_whole() const { return true; }
    bool take_whole() const { return true; }
    void measure(BorderRange range, std::span<float> out) const {
        for (uint32_t i = 0; i < range.size(); ++i) out[i] = distance_to(range.first + i);
    }
};

float OverlaySssd::distance(uint32_t low, uint32_t high) {
    const uint32_t low_patch = numbering_.innermost_patch(low), high_patch = numbering_.innermost_patch(high);
    const uint32_t top = lowest_common_patch(numbering_, low_patch, high_patch);
    const bool low_climbs = low_patch != top, high_climbs = high_patch != top;
    if (!low_climbs && !high_climbs) return distance_inside(top, low, high);
    const uint32_t climber = high_climbs ? high : low, other = high_climbs ? low : high;
    to_.climb(index_, climber, top);
    if (low_climbs && high_climbs) {
        from_.climb(index_, other, top);
        return meet(Climber{*this, from_});
    }
    const uint32_t patch = meeting_patch();
    if (const float d = distance_to_border(patch, other, climber); d < INFINITE) return d;
    const uint32_t position = numbering_.position_at_owner(other);
    return meet(KnownVertex<RingRow>{*this,
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
    if (patch != numbering_.innermost_patch(vertex) && !index_.is_labelled_whole(patch)) return INFINITE;
    for (const PatchPosition& at : numbering_.borders_of(border_vertex)) {
        if (at.patch != patch) continue;
        const uint32_t own = index_.rings.place_of_slot[numbering_.border_begin[patch] + at.position];
        return with_ring_distances(index_, vertex, patch, [&](const auto& distance_to) {
            return distance_to(index_.rings.begin[patch] + own);
        });
    }
    return INFINITE;
}

float OverlaySssd::distance_from(uint32_t source, std::span<const float> known, uint32_t target) {
    const uint32_t target_patch = numbering_.innermost_patch(target),
                   source_patch = numbering_.innermost_patch(source);
    if (target_patch < numbering_.level_begin[prepared_level_]) return known[target];
    uint32_t patch = target_patch;
    while (patch >= numbering_.level_begin[prepared_level_ + 1]) patch = numbering_.parent[patch];
    if (numbering_.is_within(source_patch, patch)) {
        const uint32_t top = lowest_common_patch(numbering_, source_patch, target_patch);
        if (target_patch == top) return known[target];
        patch = child_around(numbering_, top, target_patch);
        if (source_patch == top)
            if (const float d = distance_to_border(patch, source, target); d < INFINITE) return d;
    }
    to_.climb(index_, target, numbering_.parent[patch]);
    return meet(KnownVertex<KnownDistances>{*this, {known, index_.rings.vertex.data()}});
}

// Measures the path over the whole border where `to_` ends its climb if that takes little time, and over the
// ranges around each candidate otherwise. If the shortest path is so short that the straight way may pass
// anywhere near the ends, measures once more, over all that lies within its length.
//
// to_.climb() comes before. `From` is a Climber or a KnownVertex and is asked in this order:
// - crosses_whole(): whether all of the border may be taken;
// - if so, take_whole(); otherwise read_samples(), and then, any number of times, find_ranges() or
//   find_ranges_within(), which return whether a path leads over the ranges;
// - after each of these, measure(range, out), once `to_` has been measured, which gives the range: the
//   distances to its places on the border where `to_` ends its climb.
template <class From>
float OverlaySssd::meet(const From& from) {
    if (has_few_pairs(index_.rings, to_.ascent) && from.crosses_whole())
        return from.take_whole() && to_.ranges.take_whole(to_.ascent) ? measure(from) : INFINITE;
    to_.read_samples(index_, crossing_);
    from.read_samples();
    const uint32_t patch = meeting_patch();
    float shortest = INFINITE;
    for (const uint32_t place :
         find_candidates(index_, patch, samples_.distance, to_.ascent.sample_distances))
        if (from.find_ranges(place) && to_.ranges.find(to_.ascent, {place, place}))
            shortest = std::min(shortest, measure(from));
    if (!(shortest <= index_.pairs.samples.shortest_told[patch])) return shortest;
    const float reach = shortest + 2 * index_.pairs.samples.longest_gap[patch];
    if (from.find_ranges_within(reach) &&
        to_.ranges.find(to_.ascent, samples_within(index_, to_.ascent, reach)))
        shortest = std::min(shortest, measure(from));
    return shortest;
}

// Measures the path over the ranges that both ends have found. The kernel reads past the range up to whole
// blocks; infinity there gives no way.
template <class From>
float OverlaySssd::measure(const From& from) {
    to_.measured.measure(to_.ascent, to_.ranges.ranges(), crossing_);
    const BorderRange range = to_.measured.last_range();
    from.measure(range, from_distances_);
    std::fill_n(from_distances_.begin() + range.size(), SourceCode::BLOCK, INFINITE);
    const RingSegments segments = segments_from(index_.rings, range.first);
    return runnable_kernels().back().meet({range.size(), from_distances_.data(),
                                           to_.measured.last_distances(), segments.length,
                                           segments.half_inverse});
}

}
