#include "src/overlay/sssd/candidates.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/overlay/sssd/samples.h"

namespace geodesic {

namespace {

// An end that is nearer to a border than this many spacings of its samples counts as lying beside the border.
constexpr float BESIDE = 1;

// On a smooth surface, the ways over the two samples beside one are together longer than twice its own by
// about as much as in a plane. Where they are longer by so many of the largest spacings besides, lengths go
// up and down between samples, too, and the parabola of part_near() misses the lowest place.
constexpr float UNEVEN = 0.6f;

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

// How much longer the ways over both samples beside one are, together, than twice its own, in a plane: where
// a line between the ends crosses the border at a right angle, and samples are so far apart.
float rise_in_plane(float from, float to, float spacing) {
    const auto rise = [&](float distance) {
        return 2 * (std::sqrt(distance * distance + spacing * spacing) - distance);
    };
    return rise(from) + rise(to);
}

// A walk along a border, over the samples of the ways that are at most `longest` long.
class WalkAlong {
public:
    WalkAlong(const WaysOverSamples& ways, float longest, float spacing, float uneven)
        : ways_(ways), longest_(longest), spacing_(spacing), uneven_(uneven) {}

    // The chains of a patch's border, one after the other.
    void walk(const OverlayIndex& index, uint32_t patch) {
        const auto& lengths = ways_.lengths;
        for_each_chain_of_samples(index.rings, index.pairs.samples, patch,
                                  [&](const Rings::Chain& chain, uint32_t first, uint32_t last) {
                                      const float before_first = chain.is_closed ? lengths[last] : INFINITE,
                                                  after_last = chain.is_closed ? lengths[first] : INFINITE;
                                      for (uint32_t i = first; i <= last; ++i)
                                          if (lengths[i] <= longest_)
                                              pass(i, i > first ? lengths[i - 1] : before_first,
                                                   i < last ? lengths[i + 1] : after_last);
                                  });
    }

    // The shortest of those that are no longer than the ones over the samples on each side, in ascending
    // order.
    const std::array<Way, Candidates::MOST_BY_LENGTH>& shortest() const { return shortest_; }
    bool is_uneven() const { return is_uneven_; } // see UNEVEN

private:
    void pass(uint32_t sample, float before, float after) {
        is_uneven_ = is_uneven_ || rises_unevenly(sample, before, after);
        const float length = ways_.lengths[sample];
        if (length <= before && length <= after) keep_if_short({length, sample});
    }

    // Most samples need no square root.
    bool rises_unevenly(uint32_t sample, float before, float after) const {
        const float rise = before + after - 2 * ways_.lengths[sample];
        return rise > uneven_ && rise < INFINITE &&
               rise - rise_in_plane(ways_.from[sample], ways_.to[sample], spacing_) > uneven_;
    }

    void keep_if_short(Way way) {
        for (Way& kept : shortest_)
            if (way < kept) std::swap(way, kept);
    }

    const WaysOverSamples& ways_;
    const float longest_, spacing_, uneven_;
    std::array<Way, Candidates::MOST_BY_LENGTH> shortest_;
    bool is_uneven_ = false;
};

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
                           float least, float spacing) {
    Candidates candidates;
    const float spacing_here = index.pairs.samples.spacing[patch];
    WalkAlong along(ways, least + spacing, spacing_here, UNEVEN * spacing);
    if (least < INFINITE) along.walk(index, patch);
    candidates.are_unsure = along.is_uneven();
    uint32_t beside = sample_beside_an_end(ways, spacing_here);
    for (const Way& way : along.shortest()) {
        if (!(way.length < INFINITE)) break;
        candidates.add(way.sample);
        if (way.sample == beside) beside = NONE;
    }
    if (beside != NONE) candidates.add(beside);
    return candidates;
}

}
