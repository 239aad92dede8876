#pragma once

#include <span>

#include "tools/picture/image.h"
#include "tools/picture/view_choice.h"

namespace geodesic::tools {

// A white ball with a dark rim at each source that is not hidden.
void draw_source_marks(const DrawnSurface& surface, const View& view, const Camera& camera,
                       std::span<const uint32_t> sources, Image& image);

}
