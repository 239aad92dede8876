#include "src/overlay/sssd/candidates.h"

#include <algorithm>
#include <utility>

namespace geodesic {

namespace {

// A candidate longer than the shortest one by more than this factor is not measured.
constexpr float WORTH_MEASURING = 1.05f;

// An end that is nearer to a border than this many spacings of its samples counts as lying beside the border.
constexpr float BESIDE = 1;

// The samples of one border, by their places in its coarse ring, with the distances to both ends.
struct SamplesBetween {
    const int32_t* is_own;
    const uint32_t* sample_of_place;
    uint32_t first, end; // The places of the ring, without `end`.
    std::span<const float> from, to;

    float sum(uint32_t place) const { return from[sample_of_place[place]] + to[sample_of_place[place]]; }
    float nearer(uint32_t place) const {
        return std::min(from[sample_of_place[place]], to[sample_of_place[place]]);
    }
};

struct Way {
    float length = INFINITE;
    uint32_t place = 0;

    bool operator<(const Way& other) const {
        return length < other.length || (length == other.length && place < other.place);
    }
};

// Finds the shortest of those ways that are no longer than the ways over the two neighbouring samples, in
// ascending order.
std::array<Way, Candidates::MOST_BY_LENGTH> shortest_ways(SamplesBetween samples) {
    std::array<Way, Candidates::MOST_BY_LENGTH> shortest;
    for (uint32_t k = samples.first; k < samples.end; ++k) {
        if (!samples.is_own[k]) continue;
        Way way{samples.sum(k), k};
        if (!(way.length < INFINITE) || way.length > samples.sum(k - 1) || way.length > samples.sum(k + 1))
            continue;
        for (Way& kept : shortest)
            if (way < kept) std::swap(way, kept);
    }
    return shortest;
}

// Returns the place of the sample that is nearest to either end, if that end lies beside the border and a way
// leads over the sample, and NONE otherwise. The shortest path passes near this sample, even where samples
// alone make another way look shorter.
uint32_t place_beside_an_end(SamplesBetween samples, float spacing) {
    float least = BESIDE * spacing;
    uint32_t beside = NONE;
    for (uint32_t k = samples.first; k < samples.end; ++k) {
        const float nearer = samples.nearer(k);
        if (!samples.is_own[k] || !(samples.sum(k) < INFINITE) || nearer >= least) continue;
        least = nearer;
        beside = k;
    }
    return beside;
}

}

Candidates find_candidates(const OverlayIndex& index, uint32_t patch, std::span<const float> from,
                           std::span<const float> to) {
    const Rings& rings = index.pairs.samples.rings;
    const uint32_t first = rings.begin[patch];
    const SamplesBetween samples{rings.is_own.data(),
                                 index.pairs.samples.sample_of_place.data(),
                                 first,
                                 rings.begin[patch + 1],
                                 from,
                                 to};
    Candidates candidates;
    const auto ways = shortest_ways(samples);
    uint32_t beside = place_beside_an_end(samples, index.pairs.samples.spacing[patch]);
    for (const Way& way : ways) {
        if (!(way.length < INFINITE) || way.length > ways.front().length * WORTH_MEASURING) break;
        candidates.add(way.place - first);
        if (way.place == beside) beside = NONE;
    }
    if (beside != NONE) candidates.add(beside - first);
    return candidates;
}

}
