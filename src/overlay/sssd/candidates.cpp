#include "src/overlay/sssd/candidates.h"

#include <algorithm>
#include <utility>

#include "src/overlay/sssd/samples.h"

namespace geodesic {

namespace {

// An end that is nearer to a border than this many spacings of its samples counts as lying beside the border.
constexpr float BESIDE = 1;

struct Way {
    float length = INFINITE;
    uint32_t sample = 0;

    bool operator<(const Way& other) const {
        return length < other.length || (length == other.length && sample < other.sample);
    }
};

// The least of value(0) .. value(count - 1), or infinity. Each of four lanes has a minimum of its own, so
// that compilers take four values at once.
template <class Value>
float least_of(uint32_t count, const Value& value) {
    constexpr uint32_t LANES = 4;
    std::array<float, LANES> least;
    least.fill(INFINITE);
    uint32_t i = 0;
    for (; i + LANES <= count; i += LANES)
        for (uint32_t lane = 0; lane < LANES; ++lane) least[lane] = std::min(least[lane], value(i + lane));
    for (; i < count; ++i) least[0] = std::min(least[0], value(i));
    return std::ranges::min(least);
}

// Finds the shortest of the ways up to this length that are no longer than those over the samples on each
// side, in ascending order.
std::array<Way, Candidates::MOST_BY_LENGTH> shortest_ways(const OverlayIndex& index, uint32_t patch,
                                                          std::span<const float> lengths, float longest) {
    std::array<Way, Candidates::MOST_BY_LENGTH> shortest;
    if (!(longest < INFINITE)) return shortest;
    const auto look_along = [&](const Rings::Chain& chain, uint32_t first, uint32_t last) {
        const float before_first = chain.is_closed ? lengths[last] : INFINITE,
                    after_last = chain.is_closed ? lengths[first] : INFINITE;
        for (uint32_t i = first; i <= last; ++i) {
            if (lengths[i] > longest || lengths[i] > (i > first ? lengths[i - 1] : before_first) ||
                lengths[i] > (i < last ? lengths[i + 1] : after_last))
                continue;
            Way way{lengths[i], i};
            for (Way& kept : shortest)
                if (way < kept) std::swap(way, kept);
        }
    };
    for_each_chain_of_samples(index.rings, index.pairs.samples, patch, look_along);
    return shortest;
}

// Returns the sample that is nearest to either end, if that end lies beside the border and a way leads over
// the sample, and NONE otherwise. The shortest path passes near this sample, even where samples alone make
// another way look shorter.
uint32_t sample_beside_an_end(const WaysOverSamples& ways, float spacing) {
    float least = BESIDE * spacing;
    const auto nearer = [&](uint32_t i) { return std::min(ways.from[i], ways.to[i]); };
    if (least_of(ways.count(), nearer) >= least) return NONE;
    uint32_t beside = NONE;
    for (uint32_t i = 0; i < ways.count(); ++i) {
        if (!(ways.lengths[i] < INFINITE) || nearer(i) >= least) continue;
        least = nearer(i);
        beside = i;
    }
    return beside;
}

}

float WaysOverSamples::least() const {
    return least_of(count(), [&](uint32_t i) { return lengths[i]; });
}

Candidates find_candidates(const OverlayIndex& index, uint32_t patch, const WaysOverSamples& ways,
                           float longest) {
    Candidates candidates;
    const auto shortest = shortest_ways(index, patch, ways.lengths, longest);
    uint32_t beside = sample_beside_an_end(ways, index.pairs.samples.spacing[patch]);
    for (const Way& way : shortest) {
        if (!(way.length < INFINITE)) break;
        candidates.add(way.sample);
        if (way.sample == beside) beside = NONE;
    }
    if (beside != NONE) candidates.add(beside);
    return candidates;
}

}
