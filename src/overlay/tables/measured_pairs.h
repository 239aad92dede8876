#pragma once

#include <array>

#include "src/overlay/tables/pairs_of_vertices.h"

namespace geodesic {

// The pairs of vertices whose distance an index holds besides its tables, because what the tables say of them
// was seen to be wrong.
struct MeasuredPairs : PairsOfVertices {
    using PairsOfVertices::of;
    using PairsOfVertices::PairsOfVertices;

    // Of what tables say of these pairs, relative to their distances, by the classes of these.
    std::array<float, DISTANCE_CLASSES> largest_errors{};

    // Those whose other vertex has a number in first .. end - 1. A point of a face, whose key follows the
    // numbers of all vertices, has none.
    std::span<const Other> of(uint32_t key, uint32_t first, uint32_t end) const;

    // The distance of a pair, NULL if it is not one of these.
    const float* distance(uint32_t first, uint32_t second) const;
};

}
