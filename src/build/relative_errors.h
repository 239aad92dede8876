#pragma once

#include <span>
#include <vector>

#include "src/build/short_distances.h"
#include "src/mesh/intake.h"
#include "src/mesh/mesh.h"
#include "src/metric/workers.h"
#include "src/overlay/fields/ssad.h"
#include "src/query/index.h"

namespace geodesic {

// Distances under the metric from some random vertices of the caller's mesh to all of its vertices.
struct ExactFields {
    std::vector<uint32_t> sources;
    std::vector<std::vector<double>> distances; // of each source, per vertex
    ShortDistances too_short;
};

// Another seed chooses other sources. Where positions alone do not decide distances, the extent of a
// component is the longest distance from its sources. That of one without a source is estimated from the
// diagonal of its box, by the least ratio of the two that others have.
ExactFields exact_fields(const Description& about, const Mesh& mesh, uint64_t seed, Workers& workers);

// What decides of a distance whether it counts, and to which class of ErrorsByDistance it belongs. The
// average edge is that of the mesh where positions alone decide distances, and by the metric that of the
// edges at the sources of the fields where they do not.
struct DistanceScale {
    ShortDistances too_short;
    double average_edge;
};
DistanceScale distance_scale(const Description& about, const Mesh& mesh, const ExactFields& exact);

// What is compared: answers of an index with the metric, between the vertices of the mesh that it was built
// from, at distances that `scale` counts.
struct Compared {
    const Index& index;
    const Intake& intake;
    const DistanceScale& scale;
};

// The errors of MSAD from each of these sources alone, relative to the metric. vertex_of_number gives the
// mesh vertex of each number; those that the fields do not have, added vertices, do not count,
// nor do distances that have no relative error.
std::vector<double> relative_errors(const Index& index, Crossing crossing,
                                    std::span<const uint32_t> vertex_of_number, const ExactFields& exact,
                                    Workers& workers);

// The mean, the quantiles and the maximum of signed relative errors, in any order, and the number of sources
// that they are of. The other figures stay 0; without errors, all but that number do.
MeasuredError summary(std::vector<double> errors, size_t sources);

// Whether the answers of MSAD depend on where paths cross borders.
bool crosses_between_vertices(const Description& about);

// Whether the metric follows from the mesh alone, positions of vertices included.
bool follows_positions(const Description& about);

}
