#pragma once

#include "src/build/errors_by_distance.h"
#include "src/build/relative_errors.h"
#include "src/mesh/intake.h"
#include "src/metric/workers.h"
#include "src/query/index.h"
#include "src/tables/near_distances.h"

namespace geodesic {

// Makes an index of the overlay engine hold the metric's own distances of near vertices that it is wrong for,
// as NearComparison tells them. Where a pair is wrong that is nearly as long as what is known around its
// ends, or around their neighbours, these are looked at farther, as long as that takes no more than twice the
// work of the first look at all vertices, but not on weighted surfaces, where that would take long. If there
// are more than four pairs for each vertex, and more than 32,768 in all, a larger error than a hundredth is
// let pass. If there are fewer than four for each, pairs that make fields less steep take what room is left,
// those with the largest errors first, where positions alone decide distances. Returns the largest errors of
// near vertices that were let pass. Its progress ends at this fraction of the workers' whole work. No query
// may be running.
ErrorsByDistance hold_wrong_pairs(const Intake& intake, const DistanceScale& scale, NearDistances& near,
                                  Workers& workers, Index& index, double end_fraction);

}
