#pragma once

#include <cstdint>

#include "tests/support/meshes.h"

namespace geodesic::test {

// A square plate of side 1 with holes in rows and columns, as polygons with so many corners, which lie
// through it. The top and the bottom have no vertices but those around the holes and the four corners, and
// are cut into triangles ear by ear: most of these are slivers.
Soup drilled_plate(uint32_t holes_in_a_row, uint32_t corners_of_a_hole, double thickness);

}
