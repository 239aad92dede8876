#pragma once

#include <cstdint>

#include "src/surface/surface.h"

namespace geodesic {

// The length of the straight line between two points, not at a vertex, of different faces there, if it runs
// over the faces between the two when these are unfolded around the vertex: over edges of two faces, and
// around less than half a turn. Infinite if there is none on either side. It is the same in both directions.
double straight_around(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b, uint32_t vertex);

}
