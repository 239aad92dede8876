#pragma once

#include <vector>

#include "src/index/numbering.h"
#include "src/index/stored.h"

namespace geodesic {

// The distances of the overlay engine's tables while these are built, before they become codes.
struct DistanceTables {
    explicit DistanceTables(const Numbering& numbering);

    // overlay[p][i * overlay_size(p) + j] is the distance of the overlay positions i and j of the inner patch
    // p.
    std::vector<std::vector<float>> overlay;
    // These are laid out as in StoredIndex.
    std::vector<float> border_internal, internal;
};

// Rounds the distances to the codes of `stored`. Each patch gets the smallest quantum with which its longest
// distance is a code. Tables are handed over patch by patch, and the memory of each is freed after that.
void hand_over(DistanceTables tables, const Numbering& numbering, StoredIndex& stored);

}
