#pragma once

#include <vector>

#include "src/mesh/intake.h"
#include "src/metric/workers.h"
#include "src/query/index.h"
#include "src/tables/near_distances.h"

namespace geodesic {

// The pairs of near vertices of which MSAD gives a distance that is off by more than a hundredth, or SSSD
// does where MSAD is off by more than half of that; and of two neighbours between which MSAD from a third one
// would change by more than 1.05 times the length of their edge, the one that is worse. They are in ascending
// order, and have the metric's distances. Of more than four for each vertex, only the worst are kept.
struct WrongPairs {
    std::vector<MeasuredPair> pairs;
    double largest_error = 0; // of what the index says of them, at most 1
};
WrongPairs find_wrong_pairs(const Index& index, const Intake& intake, const NearDistances& near,
                            Workers& workers);

}
