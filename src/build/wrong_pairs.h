#pragma once

#include "src/mesh/intake.h"
#include "src/metric/workers.h"
#include "src/query/index.h"
#include "src/tables/near_distances.h"

namespace geodesic {

// Makes an index of the overlay engine hold the metric's own distances of near vertices that it is wrong for:
// where MSAD is off by more than a hundredth, or SSSD is and MSAD by more than half of that; and of two
// neighbours between which MSAD would change by more than 1.05 times the length of their edge, the one that
// is worse. If these are more than four for each vertex, a larger error is let pass. No query may be running.
void hold_wrong_pairs(const Intake& intake, const NearDistances& near, Workers& workers, Index& index);

}
