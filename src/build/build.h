#pragma once

#include "geoidx.h"
#include "src/metric/workers.h"
#include "src/query/index.h"

namespace geodesic {

// Fills an empty index (paper section 3): intake, hierarchy, borders, pruning, tables, calibration, measured
// error. Where this is over the target error of the options, the steps from borders on are made again with
// vertices added to the borders, in rounds. Then come measured pairs, steep edges and the errors that the
// index states. Throws Error by the rules of geoidx_build; the index may only be destroyed then. Calls
// options.progress from this thread only.
void build_index(const geoidx_mesh& mesh, const geoidx_build_options& options, Index& index);

}
