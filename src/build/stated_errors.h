#pragma once

#include <optional>
#include <span>

#include "src/build/errors_by_distance.h"
#include "src/build/relative_errors.h"
#include "src/mesh/intake.h"
#include "src/metric/workers.h"
#include "src/query/index.h"

namespace geodesic {

// Adds to the error that the index states what measure_error() does not see: errors by distance, the largest
// ones, and those of several sources. `fields` have been solved before: the first are those that
// measure_error() was given, and the only ones that count in means. `known` are the largest errors that
// hold_wrong_pairs() let pass, if it was called. The workers' metric gives the distances between the vertices
// of the intake's mesh, which have the same numbers in the mesh that it was made of: flat edges may be
// flipped there. No query may be running.
void state_errors(const Intake& intake, const DistanceScale& scale,
                  std::span<const ExactFields* const> fields, const std::optional<ErrorsByDistance>& known,
                  Workers& workers, Index& index);

}
