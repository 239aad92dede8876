#pragma once

#include <array>

#include "src/overlay/tables/pairs_of_vertices.h"

namespace geodesic {

// The pairs of vertices whose distance an index holds besides its tables, because what the tables say of them
// was seen to be wrong.
struct MeasuredPairs : PairsOfVertices {
    using PairsOfVertices::of;
    using PairsOfVertices::PairsOfVertices;

    // By classes of distances: the largest relative error of what tables say of these pairs.
    std::array<float, DISTANCE_CLASSES> largest_errors{};

    // Those of a vertex whose other vertex has a number in first .. end - 1.
    std::span<const Other> of(uint32_t number, uint32_t first, uint32_t end) const;

    // The distance of a pair, NULL if it is not one of these.
    const float* distance(uint32_t first, uint32_t second) const;
};

}
