#pragma once

#include <span>

#include "src/build/relative_errors.h"
#include "src/mesh/intake.h"
#include "src/metric/workers.h"
#include "src/query/index.h"

namespace geodesic {

// Adds to the error that the index states what measure_error() does not see: errors by distance, the largest
// ones, and those of several sources. `fields` have been solved before: the first are those that
// measure_error() was given, and the only ones that count in means. The workers' metric is that of the
// intake's mesh. No query may be running.
void state_errors(const Intake& intake, std::span<const ExactFields* const> fields, Workers& workers,
                  Index& index);

}
