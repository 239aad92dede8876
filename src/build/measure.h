#pragma once

#include <span>

#include "src/concurrency/workers.h"
#include "src/index/index.h"

namespace geodesic {

// Both compare MSAD with the metric for some seeded random sources, other ones each, and all vertices.
// vertex_of_number: the mesh vertex of each number; id_of_vertex: an id of each mesh vertex.

// Where paths cross borders between vertices, what lies between is estimated, and the paths found are too
// long by much the same share everywhere. Makes the distances of all overlay tables shorter by the share that
// is measured; those within a leaf, which are the metric's, stay. To be done before labels are made.
void calibrate(Index& index, std::span<const uint32_t> vertex_of_number,
               std::span<const uint32_t> id_of_vertex, Workers& workers);

// The index is as it was afterwards; for a moment its paths cross borders at vertices only.
MeasuredError measure_error(Index& index, std::span<const uint32_t> vertex_of_number,
                            std::span<const uint32_t> id_of_vertex, Workers& workers);

}
