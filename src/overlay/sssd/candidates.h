#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>

#include "src/overlay/sssd/ascent.h"
#include "src/overlay/sssd/border_crossing.h"

namespace geodesic {

// What one end knows about the samples of a border that lies across from its own last border.
struct SamplesAcross {
    SamplesAcross(const OverlayIndex& index, std::pmr::memory_resource* memory);

    Array<float> distance;
    Array<uint16_t> winner; // The place, in the coarse ring of the end's last border, that the way comes
                            // over, or BorderFromSource::NO_PLACE if there is no way.
};

// Crosses from the samples of the last border of an end to those of a sibling's border. Fills distances and
// winners. The ascent's sample_distances must have been read.
void cross_samples(const OverlayIndex& index, const Ascent& ascent, uint32_t sibling,
                   BorderCrossing& crossing, SamplesAcross& out);

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
