#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "src/overlay/tables.h"

namespace geodesic {

// The candidates of a pair of ends: a few samples of one border that the shortest path may pass near. Each is
// given by its own place in the coarse ring, counted from the ring's first place.
class Candidates {
public:
    static constexpr size_t MOST_BY_LENGTH = 3;

    void add(uint32_t place) { places_[count_++] = place; }
    const uint32_t* begin() const { return places_.data(); }
    const uint32_t* end() const { return places_.data() + count_; }

private:
    std::array<uint32_t, MOST_BY_LENGTH + 1> places_{};
    size_t count_ = 0;
};

// Chooses candidates on the border of a patch from the distances of its samples to both ends. Those by length
// come first, the shortest one foremost.
Candidates find_candidates(const OverlayIndex& index, uint32_t patch, std::span<const float> from,
                           std::span<const float> to);

}
