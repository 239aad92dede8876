#pragma once

#include <memory>

#include "geoidx.h"
#include "src/mesh/intake.h"
#include "src/metric/metric.h"

namespace geodesic {

// What geoidx_build_options, whole, say of the metric. `mesh` is the caller's, whole, that the intake was
// made from.

IntakeOptions intake_options(const geoidx_build_options& options);

// The metric that the options ask for; throws Error naming what is wrong with its parameters.
std::unique_ptr<Metric> make_metric(const geoidx_mesh& mesh, const Intake& intake,
                                    const geoidx_build_options& options);

// GEOIDX_METRIC_UNFOLDABLE or 0.
uint32_t metric_flags(const geoidx_build_options& options);

// Of what decides the metric besides the mesh; 0 where nothing does. The options must have been made a metric
// of.
uint64_t metric_fingerprint(const geoidx_build_options& options);

}
