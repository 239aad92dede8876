#pragma once

#include "src/path/strip.h"

namespace geodesic {

// The shortest path in a strip: between two portals that are vertices the strip is unfolded into the plane,
// and the path pulled tight there (Lee and Preparata 1984).
StripPath shortest_in_strip(const Surface& surface, const Strip& strip);

}
