#pragma once

#include "tests/campaign/subject.h"
#include "tests/campaign/surface_points.h"

namespace geodesic::campaign {

// Distances of points anywhere, against the metric, and against the others that must give the same bits.
void check_points(const Subject& subject, const SurfacePoints& points, geoidx_solver* solver, Dice& dice);

}
