#pragma once

#include <cstdint>
#include <span>

#include "src/overlay/hops/border_part.h"
#include "src/overlay/sssd/samples.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// The part of a border that ways up to `limit` may cross; lengths[i] is that of the way over sample i. These
// are the places beside each sample within the limit, as far as the next samples of its chain, and those
// between two samples that are so far apart that, as far as this border goes, the way over a place between
// them may be within the limit. The whole border, which must not be empty, if there is none.
BorderPart part_within(const OverlayIndex& index, uint32_t patch, std::span<const float> lengths,
                       float limit);

// A sample, those beside it (see neighbouring_samples), and the lengths of the ways over these: infinite
// where there is none.
struct WaysNearSample {
    uint32_t sample;
    NeighbouringSamples beside;
    float over_previous, over_sample, over_next;
};

// length(sample) is that of the way over a sample of the border.
template <class Length>
WaysNearSample ways_near(const OverlayIndex& index, uint32_t patch, uint32_t sample, const Length& length) {
    const auto beside = neighbouring_samples(index, patch, sample);
    const auto length_beside = [&](uint32_t other) { return other == NONE ? INFINITE : length(other); };
    return {sample, beside, length_beside(beside.previous), length(sample), length_beside(beside.next)};
}

// A few places on each side of where the shortest way near a sample crosses the border, as these lengths
// show.
BorderPart part_near(const OverlayIndex& index, uint32_t patch, const WaysNearSample& ways);

// Where a shorter way may cross a border than the one that was measured over `part` and crosses at `place`:
// the same part, unless that place is at an end of it and other places of the border lie beyond.
BorderPart part_beside(const OverlayIndex& index, uint32_t patch, const BorderPart& part, uint32_t place);

}
