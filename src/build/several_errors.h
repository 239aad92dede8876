#pragma once

#include <span>
#include <vector>

#include "src/build/errors_by_distance.h"
#include "src/build/relative_errors.h"
#include "src/mesh/intake.h"
#include "src/metric/workers.h"
#include "src/query/index.h"

namespace geodesic {

// Vertices that are sources together.
using SourceGroup = std::vector<uint32_t>;

// Groups of 2, 16 and 64 sources, fewer on small meshes: anywhere, around one vertex, and along a border;
// `rounds` of each.
std::vector<SourceGroup> source_groups(const Index& index, const Intake& intake, uint32_t rounds,
                                       uint64_t seed);

// The errors of MSAD from each group, compared with the metric, at all distances that are not too short.
ErrorSum errors_of_groups(const Compared& compared, std::span<const SourceGroup> groups, Workers& workers);

// The errors of MSAD from 2 and more of the sources of these fields, for which the metric need not be asked.
ErrorSum errors_of_known_groups(const Compared& compared, const ExactFields& exact, Workers& workers);

}
