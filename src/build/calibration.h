#pragma once

#include <span>

#include "src/index/stored.h"
#include "src/metric/workers.h"

namespace geodesic {

// Where paths cross borders between vertices, what lies between is estimated, and the paths found are too
// long by much the same share everywhere. Compares MSAD with the metric for some seeded random sources and
// all vertices, and makes the distances of all overlay tables shorter by the share that is measured; those
// within a leaf, which are the metric's, stay. vertex_of_number: the mesh vertex of each number.
void calibrate(std::span<const uint32_t> vertex_of_number, Workers& workers, StoredIndex& stored);

}
