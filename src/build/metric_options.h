#pragma once

#include <memory>
#include <vector>

#include "geoidx.h"
#include "src/mesh/intake.h"
#include "src/metric/metric.h"

namespace geodesic {

// The metric that complete geoidx_build_options describe. `mesh` is the caller's complete mesh, which the
// intake was made from.

// Throws an Error INVALID_ARGUMENT that names an option which the chosen metric does not take, or unknown
// flags.
void check_metric_options(const geoidx_build_options& options);

IntakeOptions intake_options(const geoidx_build_options& options);

// Makes the metric that the options ask for, which check_metric_options() has passed. Throws an Error that
// names what is wrong with its parameters. The tolerance is that of the exact metric.
std::unique_ptr<Metric> make_metric(const geoidx_mesh& mesh, const Intake& intake,
                                    const geoidx_build_options& options, double tolerance);

// The tolerance of the exact metric that an index is made by. Tables of the overlay engine round distances by
// more than that, or by about as much where they keep 16 bits.
double tolerance_of_tables(const geoidx_build_options& options);

// The lengths that the caller gives for the edges of the mesh, or nothing if it gives none. Throws
// as make_metric() does.
std::vector<double> given_lengths(const geoidx_mesh& mesh, const Intake& intake,
                                  const geoidx_build_options& options);

// Returns GEOIDX_METRIC_UNFOLDABLE or 0.
uint32_t metric_flags(const geoidx_build_options& options);

// Returns the fingerprint of costs and lengths, which decide the metric besides the mesh, or 0 if there are
// none. A metric must have been made from the options before, which checks them.
uint64_t metric_fingerprint(const geoidx_build_options& options);

}
