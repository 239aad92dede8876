#pragma once

#include <memory_resource>
#include <span>

#include "src/overlay/sssd/border_crossing.h"
#include "src/overlay/tables.h"

namespace geodesic {

// The largest number of samples that a border has.
size_t largest_sample_count(const OverlayIndex& index);

// What one end knows about the samples of a border after a hop to them.
struct ReachedSamples {
    ReachedSamples(const OverlayIndex& index, std::pmr::memory_resource* memory);

    Array<float> distance;
    Array<uint16_t> winner; // The place, in the coarse ring of the border before, that the way comes over, or
                            // BorderFromSource::NO_PLACE if there is no way.
};

// Hops from the samples of a patch's border, at these distances, to those of another border: a sibling's, or
// the parent's.
void hop_to_sibling(const OverlayIndex& index, uint32_t patch, std::span<const float> distances,
                    uint32_t sibling, BorderCrossing& crossing, ReachedSamples& out);
void hop_to_parent(const OverlayIndex& index, uint32_t patch, std::span<const float> distances,
                   BorderCrossing& crossing, ReachedSamples& out);

}
