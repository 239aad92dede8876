#pragma once

#include "tests/campaign/subject.h"

namespace geodesic::campaign {

// Distances of points anywhere, against the metric, and against the others that must give the same bits.
void check_points(const Subject& subject, geoidx_solver* solver, Dice& dice);

}
