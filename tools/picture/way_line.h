#pragma once

#include <array>
#include <span>

#include "tools/picture/image.h"
#include "tools/picture/view_choice.h"

namespace geodesic::tools {

// A point of a path, within the triangle of three vertices.
struct WayPoint {
    std::array<uint32_t, 3> corners;
    std::array<double, 3> weights;
};

// A white line with a dark rim along a path, where it is not hidden.
void draw_way(const DrawnSurface& surface, const View& view, const Camera& camera,
              std::span<const WayPoint> way, Image& image);

}
