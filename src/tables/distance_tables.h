#pragma once

#include <vector>

#include "src/index/index.h"

namespace geodesic {

// The tables of the overlay engine as they are built, before they become codes.
struct DistanceTables {
    explicit DistanceTables(const Index& index);

    // overlay[p][i * overlay_size(p) + j], of every inner patch.
    std::vector<std::vector<float>> overlay;
    // Placed as those of Index.
    std::vector<float> crossing, internal;
};

// Rounds the distances to the codes of index.overlay_tables, with the smallest quantum a patch that holds its
// longest distance.
void quantize(const DistanceTables& tables, Index& index);

}
