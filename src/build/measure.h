#pragma once

#include <span>

#include "src/index/stored.h"
#include "src/metric/workers.h"
#include "src/query/index.h"

namespace geodesic {

// Both compare MSAD with the metric for some seeded random sources, other ones each, and all vertices.
// vertex_of_number: the mesh vertex of each number.

// Where paths cross borders between vertices, what lies between is estimated, and the paths found are too
// long by much the same share everywhere. Makes the distances of all overlay tables shorter by the share that
// is measured; those within a leaf, which are the metric's, stay.
void calibrate(std::span<const uint32_t> vertex_of_number, Workers& workers, StoredIndex& stored);

MeasuredError measure_error(const Index& index, std::span<const uint32_t> vertex_of_number, Workers& workers);

}
