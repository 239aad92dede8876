#pragma once

#include <algorithm>
#include <memory_resource>
#include <span>

#include "src/overlay/sssd/candidates.h"
#include "src/overlay/sssd/pair_end.h"
#include "src/overlay/sssd/whole_hops.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// Single source, single destination on overlay tables. Both ends climb to the children of the lowest patch
// that has them both and meet on the border of one of these children. Short borders, and those of many short
// chains, are crossed as a whole. Of longer ones, samples tell what the path may cross: all of this is
// measured if the ends are near or the borders not much longer. Otherwise a few candidates are, each over all
// vertices of parts of borders around it, which move along with the way while it gets shorter. Vertices are
// given by their numbers. An object is the scratch of one thread.
class OverlaySssd {
public:
    // The index must have had require_pair_tables().
    OverlaySssd(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // Requires low < high; callers pass both orders of a pair this way, so that both get the same bits.
    float distance(uint32_t low, uint32_t high);
    // Whether that may be too long, by up to a quarter of the longest segment, where a field from one of
    // them, which crosses border by border, is right.
    bool may_misplace_ends(uint32_t low, uint32_t high, float distance) const;

    // Of two ends of which at least one is a point. They must not be in one leaf or on its border.
    float distance_of_points(const PathEnd& first, const PathEnd& second);

private:
    // Where `to_` has climbed to: the ends meet on the border of this patch.
    uint32_t meeting_patch() const { return to_.ascent.last_patch(); }

    float distance_inside(uint32_t patch, uint32_t low, uint32_t high) const;
    float distance_to_border(uint32_t border_vertex, uint32_t vertex) const;
    float misplaces_ends_up_to(uint32_t patch) const;
    float climb_and_meet(const PathEnd& to, const PathEnd& from, uint32_t top);
    float meet();
    float measure_all_within(float length, const WaysOverSamples& ways);
    float measure_candidates(const WaysOverSamples& ways, float least);
    WholeHops whole_hops() const;
    float distance_from_top(uint32_t place) const;
    std::span<const float> sample_from();
    void measure_ways(std::span<const float> from, std::span<const float> to);
    void take_parts(uint32_t sample, const BorderPart& of_meeting_border);
    // value(patch) is at least 0.
    template <class Value>
    float largest_of_borders(const Value& value) const {
        float largest = 0;
        for (const PairEnd* end : {&from_, &to_})
            for (const uint32_t patch : end->ascent.patches) largest = std::max(largest, value(patch));
        return largest;
    }
    float largest_spacing() const;
    float unit(uint32_t patch) const; // see NEAR_SPACINGS
    float largest_unit() const;
    float longest_of_long_segments() const;
    float follow(float other_way);
    bool move_parts(uint32_t place);
    float measure(uint32_t& place);

    const OverlayIndex& index_;
    const Numbering& numbering_;
    BorderCrossing crossing_;
    PartOfRing of_meeting_border_; // the part that was measured last
    PairEnd from_, to_;
    Array<float> from_samples_; // the distances of `from_` to the samples of the meeting border
    Array<float> lengths_;      // of the ways over these samples
    Array<float> from_distances_;
    Array<uint16_t> from_winners_; // see MeasuredEnd::cross_to()
    float farthest_misplaced_ = 0; // the largest of misplaces_ends_up_to()
};

}
