#pragma once

#include <vector>

#include "tools/picture/image.h"

namespace geodesic::tools {

// The bytes of a PNG file. Throws std::runtime_error with libpng's reason.
std::vector<unsigned char> encode_png(const Image& image);

}
