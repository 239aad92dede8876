#pragma once

#include "src/mesh/intake.h"
#include "src/metric/workers.h"
#include "src/query/index.h"

namespace geodesic {

// An edge along which a field changes by more than this many times its length is held as steep, and fields
// are lowered to that. It is a little less than the 1.05 of geoidx.h, since distances are rounded to floats.
inline constexpr double STEEPEST = 1.049;

// Makes an index of the overlay engine hold the edges of the mesh along which its fields are steeper than
// that, so that they are lowered there. It looks at the fields of all vertices; if the mesh has n vertices
// and n is more than 65,536, at those of 2^32 / n, evenly spread. What is lowered may make other edges steep,
// so that all fields that had a steep edge are looked at again until no new one is found. Its progress ends
// at this fraction of the workers' whole work. No query may be running.
void hold_steep_edges(const Intake& intake, Workers& workers, Index& index, double end_fraction);

}
