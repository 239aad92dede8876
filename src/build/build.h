#pragma once

#include <memory>

#include "geoidx.h"
#include "src/concurrency/workers.h"
#include "src/index/index.h"
#include "src/mesh/intake.h"
#include "src/metric/metric.h"

namespace geodesic {

IntakeOptions intake_options(const geoidx_build_options& options);

// The metric that the options ask for. `options` as geoidx_build_options, whole.
std::unique_ptr<Metric> make_metric(const Intake& intake, const geoidx_build_options& options);

// Builds an index (paper section 3): intake, hierarchy, borders, pruning, tables, measured error.
void build_index(const geoidx_mesh& mesh, const geoidx_build_options& options, Index& index);

}
