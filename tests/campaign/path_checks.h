#pragma once

#include "tests/campaign/subject.h"

namespace geodesic::campaign {

// Paths and walks between points anywhere, against the metric and the mesh.
void check_paths(const Subject& subject, geoidx_solver* solver, Dice& dice);

}
