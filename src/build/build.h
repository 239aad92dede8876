#pragma once

#include "geoidx.h"
#include "src/concurrency/workers.h"
#include "src/index/index.h"

namespace geodesic {

// Builds an index (paper section 3): intake, hierarchy, borders, pruning, tables, measured error.
void build_index(const geoidx_mesh& mesh, const geoidx_build_options& options, Index& index);

}
