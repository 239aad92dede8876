#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "src/overlay/tables/tables.h"

namespace geodesic {

// The ways between two ends over the samples of one border, straightened over long segments.
struct WaysOverSamples {
    std::span<const float> from, to; // the distances of both ends, by samples
    std::span<const float> lengths;  // of the ways

    uint32_t count() const { return static_cast<uint32_t>(lengths.size()); }
    // The least length, or infinity.
    float least() const;
};

// The candidates of a pair of ends: a few samples of one border that the shortest path may pass near.
class Candidates {
public:
    static constexpr size_t MOST_BY_LENGTH = 3;

    void add(uint32_t sample) { samples_[count_++] = sample; }
    const uint32_t* begin() const { return samples_.data(); }
    const uint32_t* end() const { return samples_.data() + count_; }

    // Whether the lengths of ways go up and down along the border, so that the shortest path may pass near
    // none of the candidates, or beside them.
    bool are_unsure = false;

private:
    std::array<uint32_t, MOST_BY_LENGTH + 1> samples_{};
    size_t count_ = 0;
};

// Chooses candidates of a patch's border. Those by length come first, the shortest one foremost; a candidate
// by length is longer than `least`, which is ways.least(), by no more than `spacing`, the largest one of
// samples on the way: as much as ways can get shorter when they are straightened.
Candidates find_candidates(const OverlayIndex& index, uint32_t patch, const WaysOverSamples& ways,
                           float least, float spacing);

}
