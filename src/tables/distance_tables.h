#pragma once

#include <vector>

#include "src/index/numbering.h"
#include "src/index/stored.h"

namespace geodesic {

// The tables of the overlay engine as they are built, before they become codes.
struct DistanceTables {
    explicit DistanceTables(const Numbering& numbering);

    // overlay[p][i * overlay_size(p) + j], of every inner patch.
    std::vector<std::vector<float>> overlay;
    // Laid out as StoredIndex has them.
    std::vector<float> border_internal, internal;
};

// Rounds the distances to the codes of `stored`, with the smallest quantum a patch that holds its longest
// distance. Tables are handed over patch by patch, and each one's memory is given back.
void hand_over(DistanceTables tables, const Numbering& numbering, StoredIndex& stored);

}
