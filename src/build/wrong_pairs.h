#pragma once

#include <vector>

#include "src/mesh/intake.h"
#include "src/metric/workers.h"
#include "src/query/index.h"
#include "src/tables/near_distances.h"

namespace geodesic {

// The pairs of near vertices of which MSAD or SSSD gives a distance that is off by more than a hundredth, and
// those between which and their neighbours MSAD would be too steep: it is to change along an edge by no more
// than 1.05 times the edge's length. They are in ascending order, and have the metric's distances. Of more
// than four for each vertex, only the worst are kept.
std::vector<MeasuredPair> find_wrong_pairs(const Index& index, const Intake& intake,
                                           const NearDistances& near, Workers& workers);

}
