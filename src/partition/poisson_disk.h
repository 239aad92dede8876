#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/metric/metric.h"
#include "src/partition/random.h"

namespace geodesic {

// Chooses `count` of the candidate vertices, both at least one, as Poisson-disk samples under the metric
// (Corsini, Cignoni, Scopigno 2012; the paper's section 3.1): no two of them are closer to each other than
// some radius, and every other candidate lies within about that radius of one of them, or in a component that
// has no sample and is not wider than that. Fewer are chosen only if all other candidates are at distance 0
// from a sample. component_of_vertex is that of the mesh's Components.
std::vector<uint32_t> poisson_disk_samples(FieldSolver& solver, std::span<const uint32_t> component_of_vertex,
                                           std::span<const uint32_t> candidates, uint32_t count,
                                           Random& random);

}
