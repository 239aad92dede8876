#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/metric/metric.h"
#include "src/partition/random.h"

namespace geodesic {

// At most `count` of the candidate vertices, no two closer to each other than a radius that the rest all lie
// within (up to the last step of its search): Poisson-disk samples under the metric (Corsini, Cignoni,
// Scopigno 2012; the paper's section 3.1). Fewer only where there are fewer candidates.
std::vector<uint32_t> poisson_disk_samples(FieldSolver& solver, std::span<const uint32_t> candidates,
                                           uint32_t count, Random& random);

}
