#pragma once

#include "src/surface/surface.h"

namespace geodesic {

// Where a way crosses an edge, and how long it is from there to the target.
struct EdgeCrossing {
    double share = 0; // from the first vertex of the edge
    double rest = UNREACHABLE;
};

// The crossing of the shortest way from a position over the edge between two vertices, whose distances from
// the target are known: straight to where these place the target, if they do.
EdgeCrossing cross_edge(const Surface& surface, uint32_t a, uint32_t b, const Eigen::Vector3d& from,
                        double rest_a, double rest_b);

}
