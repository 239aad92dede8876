#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "src/base/numbers.h"

namespace geodesic {

// The ways between two ends over the samples of one border, straightened over long segments.
struct WaysOverSamples {
    std::span<const float> from, to; // the distances of both ends, by samples
    std::span<const float> lengths;  // of the ways
    bool is_round;                   // The first sample comes after the last one, too.

    uint32_t count() const { return static_cast<uint32_t>(lengths.size()); }
    // The least length, or infinity.
    float least() const;
    float length(uint32_t sample) const { return lengths[sample]; }
    // Infinity if there is no such sample.
    float length_of_previous(uint32_t sample) const {
        return sample > 0 ? length(sample - 1) : is_round ? length(count() - 1) : INFINITE;
    }
    float length_of_next(uint32_t sample) const {
        return sample + 1 < count() ? length(sample + 1) : is_round ? length(0) : INFINITE;
    }
};

// The candidates of a pair of ends: a few samples of one border that the shortest path may pass near.
class Candidates {
public:
    static constexpr size_t MOST_BY_LENGTH = 3;

    void add(uint32_t sample) { samples_[count_++] = sample; }
    const uint32_t* begin() const { return samples_.data(); }
    const uint32_t* end() const { return samples_.data() + count_; }

private:
    std::array<uint32_t, MOST_BY_LENGTH + 1> samples_{};
    size_t count_ = 0;
};

// Chooses candidates; `least` is ways.least(), `spacing` that of the samples. Those by length come first, the
// shortest one foremost.
Candidates find_candidates(const WaysOverSamples& ways, float least, float spacing);

}
