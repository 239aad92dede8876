#pragma once

#include <span>

#include "src/surface/surface.h"

namespace geodesic {

// Where a way crosses an edge, and how long it is from there to the target.
struct EdgeCrossing {
    double share = 0; // from the first vertex of the edge
    double rest = UNREACHABLE;
};

// The crossing of the shortest way from a position over the edge between two vertices, whose distances from
// the target are known, and those of evenly spaced points between them, of which there may be none. Between
// two such points the way is straight to where their distances place the target, if they do.
EdgeCrossing cross_edge(const Surface& surface, uint32_t a, uint32_t b, const Eigen::Vector3d& from,
                        double from_a, std::span<const double> inside, double from_b);

}
