#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/metric/metric.h"
#include "src/partition/random.h"

namespace geodesic {

// Chooses `count` of the candidate vertices, at least one of each, as Poisson-disk samples under the metric
// (Corsini, Cignoni, Scopigno 2012; the paper's section 3.1): no two of them are closer to each other than
// some radius, and all other candidates lie within about that radius of one of them, or in a component
// without samples that extends no farther. It chooses fewer only if no other candidate is apart from those.
std::vector<uint32_t> poisson_disk_samples(FieldSolver& solver, std::span<const uint32_t> candidates,
                                           uint32_t count, Random& random);

}
