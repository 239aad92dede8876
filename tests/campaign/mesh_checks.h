#pragma once

#include "tests/campaign/random_options.h"

namespace geodesic::campaign {

// Builds the mesh with the options and asks every query of the API; throws Finding where an answer cannot be
// right.
void check_case(const test::Soup& soup, const CaseOptions& options);

}
