#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/build/short_distances.h"
#include "src/mesh/mesh.h"
#include "src/metric/workers.h"
#include "src/partition/hierarchy.h"

namespace geodesic {

// Where several windows of the exact metric lie on one long segment of a border, one unfolding between its
// ends cannot follow them, and paths across it come out too long or too short. Added vertices make such
// segments shorter: edges between two leaves are cut in halves, which changes no distance on the surface.

// An edge between two leaves, and how far off unfolding is there.
struct BorderEdge {
    uint32_t edge;
    double deviation;
};

// The edges between two or more leaves, those with the largest deviations first. The deviation of an edge is
// the mean, over the sources, of the relative error that the distance of its middle has if it is unfolded
// from those of its two ends. Errors are relative, so that an edge counts more for the sources near it, as it
// does for queries: more of their paths cross it, and the same length is a larger share of these. The
// workers' metric is the exact one of this mesh. Middles that are too near a source to have a relative error
// do not count.
std::vector<BorderEdge> border_edges(const Mesh& mesh, std::span<const uint32_t> leaf_of_face,
                                     std::span<const uint32_t> sources, const ShortDistances& too_short,
                                     Workers& workers);

// How many of these edges, from the first on, have together at least this share of the sum of all
// deviations. Edges without deviation are never among them.
size_t count_for_share(std::span<const BorderEdge> edges, double share);

// A mesh of the same surface with the hierarchy that belongs to it.
struct FinerSurface {
    Mesh mesh;
    Hierarchy hierarchy;
};

// Cuts these edges in halves. Each part of a face lies in the same leaf as the face.
FinerSurface with_finer_borders(const Mesh& mesh, const Hierarchy& hierarchy,
                                std::span<const BorderEdge> edges);

}
