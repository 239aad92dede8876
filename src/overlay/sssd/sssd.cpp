#include "src/overlay/sssd/sssd.h"

#include <algorithm>
#include <cmath>

#include "src/overlay/kernels/dispatch.h"
#include "src/overlay/kernels/unfolding.h"
#include "src/overlay/sssd/border_parts.h"
#include "src/overlay/sssd/samples.h"
#include "src/overlay/tables/ring_segments.h"

namespace geodesic {

namespace {

// A pair is near if its shortest way over samples is shorter than so many units of the meeting border, or
// half as many of any border that it crosses. A unit is the spacing of the border's samples or its longest
// segment, whichever is longer, but a segment counts as so many spacings at most: a few segments that are
// much longer than all others do not make more pairs near. Samples make ways longer by a share of a spacing,
// so that the shortest way of a near pair need not be the shortest one over samples. Everything that it can
// cross is measured.
constexpr float NEAR_SPACINGS = 14, MOST_SPACINGS_OF_SEGMENT = 4;

// Ways over samples may also be longer than the true ones by half of a long segment, where the way back is
// not straightened.
constexpr float LONGER_BY_SEGMENT = 0.5f;

// Distances over samples come from rounded codes: they may be too short by less than this share.
constexpr float SAMPLES_ROUNDING = 1e-3f;

// A distance that begins at labels is a sum of two that were rounded, each by half a step, and by more where
// distances along a border change faster than its segments are long (label_rows.h). One of fewer steps than
// this is measured again without labels.
constexpr float FEW_STEPS = 1000;

// Parts are moved along with the way at most this many times.
constexpr int MOST_MOVES = 8;

// Returns the lowest patch that two patches lie in. A parent has a smaller number than its children.
uint32_t lowest_common_patch(const Numbering& numbering, uint32_t a, uint32_t b) {
    while (a != b) (a > b ? a : b) = numbering.parent[std::max(a, b)];
    return a;
}

// The index of the place that has the least sum of the distances from both ends.
uint32_t index_of_least_sum(const float* from, const float* to, uint32_t count) {
    float least = INFINITE;
    uint32_t index = 0;
    for (uint32_t i = 0; i < count; ++i) {
        if (from[i] + to[i] >= least) continue;
        least = from[i] + to[i];
        index = i;
    }
    return index;
}

}

OverlaySssd::OverlaySssd(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : index_(index), numbering_(index.numbering), crossing_(index, memory),
      of_meeting_border_(index.rings, memory), from_(index, memory), to_(index, memory),
      from_samples_(memory), lengths_(memory), from_distances_(index.rings.room_for_places(), memory),
      from_winners_(from_distances_.size(), memory) {
    for (uint32_t p = 0; p < numbering_.patch_count(); ++p)
        farthest_misplaced_ = std::max(farthest_misplaced_, misplaces_ends_up_to(p));
}

float OverlaySssd::distance(uint32_t low, uint32_t high) {
    const uint32_t low_patch = numbering_.innermost_patch(low), high_patch = numbering_.innermost_patch(high);
    const uint32_t top = lowest_common_patch(numbering_, low_patch, high_patch);
    const bool low_climbs = low_patch != top, high_climbs = high_patch != top;
    if (!low_climbs && !high_climbs) return distance_inside(top, low, high);
    const uint32_t climber = high_climbs ? high : low, other = high_climbs ? low : high;
    if (!low_climbs || !high_climbs)
        if (const float d = distance_to_border(other, climber); d < INFINITE) return d;
    return climb_and_meet({climber}, {other}, top);
}

// A point always climbs: the leaves around it have both ends together in no table.
float OverlaySssd::distance_of_points(const PathEnd& first, const PathEnd& second) {
    const uint32_t first_patch = innermost_patch(numbering_, first),
                   second_patch = innermost_patch(numbering_, second);
    const uint32_t top = lowest_common_patch(numbering_, first_patch, second_patch);
    const bool second_climbs = second_patch != top;
    return climb_and_meet(second_climbs ? second : first, second_climbs ? first : second, top);
}

// Where several faces meet at edges, borders consist of many short chains, and an end may see the middle of a
// segment alone, as through a window, so that the distances of the segment's ends do not tell where it lies.
// The way that is found then is longer by up to a quarter of the longest segment.
bool OverlaySssd::may_misplace_ends(uint32_t low, uint32_t high, float distance) const {
    if (!(distance < farthest_misplaced_)) return false;
    const uint32_t low_patch = numbering_.innermost_patch(low), high_patch = numbering_.innermost_patch(high);
    const uint32_t top = lowest_common_patch(numbering_, low_patch, high_patch);
    for (uint32_t patch : {low_patch, high_patch})
        for (; patch != top; patch = numbering_.parent[patch])
            if (distance < misplaces_ends_up_to(patch)) return true;
    return false;
}

// The distance up to which the border of a patch makes a pair worth another question: that of four segments,
// of which a quarter of one is 6 %.
float OverlaySssd::misplaces_ends_up_to(uint32_t patch) const {
    constexpr float SEGMENTS = 4;
    return has_short_chains(index_, patch) ? SEGMENTS * index_.longest_segment[patch] : 0;
}

// Labels have coarse steps: a distance of few of them is measured without.
float OverlaySssd::climb_and_meet(const PathEnd& to, const PathEnd& from, uint32_t top) {
    to_.climb(index_, to, top, true);
    from_.climb(index_, from, top, true);
    const float distance = meet();
    const float quantum = std::max(to_.ascent.label_quantum, from_.ascent.label_quantum);
    if (distance >= FEW_STEPS * quantum) return distance;
    to_.climb(index_, to, top, false);
    from_.climb(index_, from, top, false);
    return meet();
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

// Returns the distance between two vertices if the first one lies on the border of the innermost patch around
// the second one, and infinity otherwise.
float OverlaySssd::distance_to_border(uint32_t border_vertex, uint32_t vertex) const {
    const uint32_t patch = numbering_.innermost_patch(vertex);
    const uint32_t position = numbering_.border_position(patch, border_vertex);
    if (position == NONE) return INFINITE;
    return inner_row_of(index_, vertex)(own_place(index_.rings, numbering_, patch, position));
}

// Measures the path over whole borders if these are few pairs of places. Otherwise finds the ways over
// samples. If no border has segments, all vertices are samples, and the shortest of these ways is the path.
// Else the path is measured over all that it can cross, if the ends are near, whole borders would be some
// pairs or candidates are unsure, and otherwise over the parts near each candidate. The way over samples is
// the answer, too, if it is shorter than what was measured by more than rounding: the best path may need a
// segment or a row that is in none of the measured parts.
float OverlaySssd::meet() {
    read_label(index_, to_.ascent);
    read_label(index_, from_.ascent);
    const WholeHops whole = whole_hops();
    if (whole.are_few()) {
        uint32_t place;
        return from_.take_whole_borders(index_) && to_.take_whole_borders(index_) ? measure(place) : INFINITE;
    }
    to_.sampled.climb(to_.ascent);
    const std::span<const float> from = sample_from(), to = to_.sampled.last_distances();
    measure_ways(from, to);
    const WaysOverSamples ways{from, to, lengths_};
    const float least = ways.least();
    const bool crosses_segments = to_.crosses_segments(index_) || from_.crosses_segments(index_);
    if (!crosses_segments || !(least < INFINITE)) return least;
    const float near_up_to = NEAR_SPACINGS * std::max(unit(meeting_patch()), 0.5f * largest_unit());
    const bool is_near = least < near_up_to;
    const float shortest =
        is_near || whole.are_some() ? measure_all_within(least, ways) : measure_candidates(ways, least);
    return shortest <= least * (1 + SAMPLES_ROUNDING) ? shortest : least;
}

// Measures all that a path can cross whose shortest way over samples has this length, however much that is.
float OverlaySssd::measure_all_within(float length, const WaysOverSamples& ways) {
    const float longest =
        length + std::max(MOST_LONGER * largest_spacing(), LONGER_BY_SEGMENT * longest_of_long_segments());
    const BorderPart of_meeting_border = part_within(index_, meeting_patch(), ways.lengths, longest);
    to_.sampled.go_back(ways.from);
    to_.take_parts_within(index_, longest);
    to_.parts.back() = of_meeting_border;
    if (!from_.is_at_top()) {
        from_.sampled.go_back(ways.to);
        from_.take_parts_within(index_, longest);
    }
    uint32_t place;
    return measure(place);
}

// Measures the candidates of a pair whose shortest way over samples has this length, or all that a path can
// cross if they are unsure.
float OverlaySssd::measure_candidates(const WaysOverSamples& ways, float least) {
    const uint32_t patch = meeting_patch();
    const Candidates candidates = find_candidates(index_, patch, ways, least, largest_spacing());
    if (candidates.are_unsure) return measure_all_within(least, ways);
    float shortest = INFINITE;
    for (const uint32_t sample : candidates) {
        const auto length = [&](uint32_t over) { return lengths_[over]; };
        take_parts(sample, part_near(index_, patch, ways_near(index_, patch, sample, length)));
        shortest = std::min(shortest, follow(shortest));
    }
    return shortest;
}

// Of the borders that the ways cross.
float OverlaySssd::largest_spacing() const {
    return largest_of_borders([&](uint32_t patch) { return index_.pairs.samples.spacing[patch]; });
}
float OverlaySssd::unit(uint32_t patch) const {
    const float spacing = index_.pairs.samples.spacing[patch];
    return std::max(spacing, std::min(index_.longest_segment[patch], MOST_SPACINGS_OF_SEGMENT * spacing));
}
float OverlaySssd::largest_unit() const {
    return largest_of_borders([&](uint32_t patch) { return unit(patch); });
}
float OverlaySssd::longest_of_long_segments() const {
    return largest_of_borders([&](uint32_t patch) {
        return index_.pairs.samples.long_segments_of(patch).empty() ? 0 : index_.longest_segment[patch];
    });
}

// The hops if all borders are crossed as a whole.
WholeHops OverlaySssd::whole_hops() const {
    WholeHops hops;
    for (const PairEnd* end : {&from_, &to_})
        for (size_t b = 1; b < end->ascent.patches.size(); ++b)
            hops.add(index_, end->ascent.patches[b - 1], end->ascent.patches[b]);
    if (!from_.is_at_top()) hops.add(index_, from_.ascent.last_patch(), meeting_patch());
    return hops;
}

// Returns the distance of `from_`, which is at the top, from the vertex at a place of the meeting border.
float OverlaySssd::distance_from_top(uint32_t place) const {
    const uint32_t patch = meeting_patch(), top = numbering_.parent[patch];
    const uint32_t from = numbering_.position_at_owner(from_.ascent.vertex);
    return index_.distance(index_.overlay_code(top, from, index_.position_in_parent(patch, place)), top);
}

// Returns the distances of `from_` to the samples of the meeting border.
std::span<const float> OverlaySssd::sample_from() {
    if (!from_.is_at_top()) {
        from_.sampled.climb(from_.ascent);
        from_.sampled.hop_across(from_.ascent, meeting_patch());
        return from_.sampled.last_distances();
    }
    from_samples_.clear();
    for (const uint16_t place : index_.pairs.samples.of(meeting_patch()))
        from_samples_.push_back(distance_from_top(index_.rings.begin[meeting_patch()] + place));
    return from_samples_;
}

// Measures the ways over the samples of the meeting border. A way over a long segment counts for the
// samples at both of its ends.
void OverlaySssd::measure_ways(std::span<const float> from, std::span<const float> to) {
    lengths_.resize(from.size());
    for (size_t i = 0; i < from.size(); ++i) lengths_[i] = from[i] + to[i];
    for (const auto& [first, second, length] : index_.pairs.samples.long_segments_of(meeting_patch())) {
        const auto all = [](float value) { return BesideFloats{} + value; };
        SegmentsFromSource<BesideFloats> from_source{{all(length), all(0.5f / length)}, {}, {}};
        from_source.segments.place_point(all(from[first]), all(from[second]), from_source.foot,
                                         from_source.height);
        BesideFloats square;
        from_source.square_across(all(to[first]), all(to[second]), square);
        for (const uint32_t end : {first, second})
            lengths_[end] = std::min(lengths_[end], std::sqrt(square[0]));
    }
}

// Takes the parts of both ends near the ways over samples to a sample of the meeting border.
void OverlaySssd::take_parts(uint32_t sample, const BorderPart& of_meeting_border) {
    to_.take_parts(index_, sample, of_meeting_border);
    if (!from_.is_at_top()) {
        const size_t meeting = from_.ascent.patches.size();
        const uint32_t before = from_.sampled.sample_before(meeting, sample);
        from_.take_parts(
            index_, before,
            part_before(index_, from_.ascent.last_patch(), from_.sampled, meeting, before, sample));
    }
}

// Measures the path over the parts that both ends have taken, and moves the parts along with it while it
// gets shorter, unless it is longer than another way from the beginning.
float OverlaySssd::follow(float other_way) {
    float shortest = INFINITE;
    for (int moves = 0; moves <= MOST_MOVES; ++moves) {
        uint32_t place;
        const float length = measure(place);
        if (!(length < shortest)) break;
        shortest = length;
        if (shortest >= other_way || !move_parts(place)) break;
    }
    return shortest;
}

// Moves the parts of both ends to where a shorter way may be than the one that was measured, which crosses
// the meeting border at this place. Returns whether any has moved.
bool OverlaySssd::move_parts(uint32_t place) {
    bool moved = to_.move_parts(index_, place);
    if (!from_.is_at_top()) {
        const uint16_t winner = from_winners_[to_.measured.last_part().index(place)];
        moved = from_.move_parts(index_, index_.rings.begin[from_.ascent.last_patch()] + winner) || moved;
    }
    return moved;
}

// Measures the path over the parts that both ends have taken, and finds the place where it crosses the
// meeting border, if there is a path. The kernel reads past the part up to whole blocks; infinity there
// gives no way.
float OverlaySssd::measure(uint32_t& place) {
    to_.measured.measure(to_.ascent, to_.parts, crossing_);
    const BorderPart& part = to_.measured.last_part();
    if (from_.is_at_top()) {
        float* distance = from_distances_.data();
        part.for_each_place([&](uint32_t of_part) { *distance++ = distance_from_top(of_part); });
    } else {
        from_.measured.measure(from_.ascent, from_.parts, crossing_);
        from_.measured.cross_to(from_.ascent, meeting_patch(), part, crossing_, from_distances_,
                                from_winners_);
    }
    std::fill_n(from_distances_.begin() + part.size(), SourceCode::BLOCK, INFINITE);
    const float* to = to_.measured.last_distances();
    place = part.place(index_of_least_sum(from_distances_.data(), to, part.size()));
    of_meeting_border_.take(part);
    const RingSegments segments = of_meeting_border_.segments();
    return runnable_kernels().back().meet(
        {part.size(), from_distances_.data(), to, segments.length, segments.half_inverse});
}

}
