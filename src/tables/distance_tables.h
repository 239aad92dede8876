#pragma once

#include <vector>

#include "src/index/numbering.h"
#include "src/index/stored.h"

namespace geodesic {

// The distances of the overlay engine's tables while these are built, before they become codes.
struct DistanceTables {
    DistanceTables() = default;
    explicit DistanceTables(const Numbering& numbering);

    // overlay[p][i * overlay_size(p) + j] is the distance of the overlay positions i and j of the inner patch
    // p.
    std::vector<std::vector<float>> overlay;
    // These are laid out as in StoredIndex.
    std::vector<float> border_internal, internal;
};

// Rounds the distances of one patch to codes and adds them to `stored`; the table of an inner patch is freed.
// Patches are handed over in the order of their numbers, each as soon as no other table is filled from its
// own. Distances are rounded to about `rounding`, see choose_steps().
void hand_over(uint32_t patch, const Numbering& numbering, float rounding, DistanceTables& tables,
               StoredIndex& stored);

}
