#pragma once

#include "tests/campaign/subject.h"
#include "tests/campaign/surface_points.h"

namespace geodesic::campaign {

// Paths and walks between points anywhere, against the metric and the mesh.
void check_paths(const Subject& subject, const SurfacePoints& points, geoidx_solver* solver, Dice& dice);

}
