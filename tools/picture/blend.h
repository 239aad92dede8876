#pragma once

#include <cstdint>

#include "tools/picture/colour_map.h"

namespace geodesic::tools {

// Lays a colour over a pixel of an image.
void blend(uint8_t* pixel, Colour colour, double opacity);

}
