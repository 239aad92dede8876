#pragma once

#include "src/mesh/intake.h"
#include "src/metric/workers.h"
#include "src/query/index.h"

namespace geodesic {

// // Along an edge, exact distances change by no more than its length, and answers by no more than this many
// times its length: a little less than the 1.05 of geoidx.h, so that rounding seldom passes that.
inline constexpr double STEEPEST = 1.049;

// Makes an index of the overlay engine hold the edges of the mesh along which its fields are steeper than
// that, so that they are lowered there. It looks at the fields of all vertices, unless the mesh has more than
// 65,536: then at those of as many vertices as take as much work. What is lowered may make other edges steep,
// so that fields with steep edges are looked at again until there are no new ones. Its progress ends at this
// fraction of the workers' whole work. No query may be running.
void hold_steep_edges(const Intake& intake, Workers& workers, Index& index, double end_fraction);

}
