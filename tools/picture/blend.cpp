#include "tools/picture/blend.h"

#include <cmath>

namespace geodesic::tools {

void blend(uint8_t* pixel, Colour colour, double opacity) {
    const Colour under = linear_from_srgb({pixel[0] / 255.0, pixel[1] / 255.0, pixel[2] / 255.0});
    const Colour srgb = srgb_from_linear(mix(under, colour, opacity));
    pixel[0] = static_cast<uint8_t>(std::lround(255 * srgb.x));
    pixel[1] = static_cast<uint8_t>(std::lround(255 * srgb.y));
    pixel[2] = static_cast<uint8_t>(std::lround(255 * srgb.z));
}

}
