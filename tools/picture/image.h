#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace geodesic::tools {

// Eight-bit sRGB, three bytes a pixel, rows from the top.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<uint8_t> pixels;

    uint8_t* pixel(int x, int y) {
        return pixels.data() +
               3 * (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x));
    }
    const uint8_t* pixel(int x, int y) const { return const_cast<Image*>(this)->pixel(x, y); }
};

}
