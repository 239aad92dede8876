#pragma once

#include <optional>

#include "tools/picture/camera.h"

namespace geodesic::tools {

// Is the point not hidden by the surface (but for what is just around it)?
class VisibilityTest {
public:
    VisibilityTest(const DrawnSurface& surface, const View& view);
    bool operator()(Vec3 position) const;

    const Camera& camera() const { return camera_; }
    // The part of the picture that the surface covers: little where a flat one is seen edge-on.
    double filled_part() const;

private:
    Camera camera_;
    std::vector<float> nearness_;
};

// Of a few three-quarter views the one in which the source is visible and turned to the viewer.
View view_of_source(const DrawnSurface& surface, std::optional<uint32_t> source, UpAxis up);

}
