#pragma once

#include <span>

#include "src/concurrency/workers.h"
#include "src/index/index.h"

namespace geodesic {

// Compares MSAD with the metric for some seeded random sources and all vertices. vertex_of_number: the mesh
// vertex of each number; id_of_vertex: an id of each mesh vertex. The index is as it was afterwards; for a
// moment its paths cross borders at vertices only.
MeasuredError measure_error(Index& index, std::span<const uint32_t> vertex_of_number,
                            std::span<const uint32_t> id_of_vertex, Workers& workers);

}
