#pragma once

#include <span>

#include "tools/picture/image.h"
#include "tools/picture/view_choice.h"
#include "tools/picture/way_line.h"

namespace geodesic::tools {

struct PictureOptions {
    int width = 1200;
    int height = 1000;
    uint32_t isolines = 24;
    UpAxis up = UpAxis::y;
    std::optional<View> view; // otherwise chosen so that the first source is seen
};

// Draws the mesh coloured by a distance per vertex, with lines of equal distance, a path if there is one, and
// a mark at each source. Unreachable (infinite) parts are grey. Throws std::runtime_error for a position that
// is not finite.
Image render_field(const TriangleMesh& mesh, std::span<const float> distances,
                   std::span<const uint32_t> sources, const PictureOptions& options,
                   std::span<const WayPoint> way = {});

}
