#pragma once

#include <limits>
#include <span>

#include "tools/picture/camera.h"

namespace geodesic::tools {

inline constexpr uint32_t NO_TRIANGLE = std::numeric_limits<uint32_t>::max();

// Rows first_row .. first_row + row_count - 1 of a picture: what is nearest at the centre of each pixel.
struct VisibilityBuffer {
    VisibilityBuffer(int width, int first_row, int row_count);

    size_t at(int x, int y) const {
        return static_cast<size_t>(y - first_row) * static_cast<size_t>(width) + static_cast<size_t>(x);
    }

    int width;
    int first_row;
    int row_count;
    std::vector<float> nearness;
    std::vector<uint32_t> triangle;
};

// Barycentric coordinates on the screen as affine functions of the pixel.
struct ScreenTriangle {
    ScreenTriangle(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c);

    bool is_visible() const { return double_area != 0; }
    std::array<double, 3> weights(double x, double y) const;

    std::array<ScreenPoint, 3> corners;
    double double_area;                 // signed
    std::array<double, 3> weight_per_x; // of each corner
    std::array<double, 3> weight_per_y;
};

// Draws all triangles into the buffer; either side of a triangle is visible.
void rasterize(const DrawnSurface& surface, std::span<const ScreenPoint> points, VisibilityBuffer& buffer);

}
