#pragma once

#include "tools/picture/surface.h"

namespace geodesic::tools {

// Per vertex, how much of the sky it sees: 0 (a deep fold) .. 1 (open). Counted by looking at the surface
// from many sides.
std::vector<float> sky_visibility(const DrawnSurface& surface);

}
