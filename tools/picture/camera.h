#pragma once

#include <vector>

#include "tools/picture/surface.h"

namespace geodesic::tools {

enum class UpAxis { x, y, z };

// From where the mesh is looked at. Degrees; azimuth 0, elevation 0 looks along -z with y up, and a growing
// azimuth goes round to the right.
struct View {
    double azimuth = 30;
    double elevation = 20;
    UpAxis up = UpAxis::y;
    bool perspective = true;
};

// Screen coordinates grow to the right and downwards; nearness grows towards the viewer and is affine on the
// screen, so that it can be interpolated there.
struct ScreenPoint {
    double x = 0;
    double y = 0;
    double nearness = 0;
};

struct Camera {
    Vec3 right;
    Vec3 up;
    Vec3 back; // towards the viewer
    bool perspective = true;
    double scale = 1; // screen units per unit of the mesh at distance 1, or at any for a parallel view
    double shift_x = 0;
    double shift_y = 0;

    ScreenPoint project(Vec3 position) const;
};

// A camera whose picture of the surface fills width x height up to a margin, in the middle.
Camera fitted_camera(const DrawnSurface& surface, const View& view, double width, double height,
                     double margin);

// The same camera for a picture `factor` times as large.
Camera magnified(Camera camera, double factor);

std::vector<ScreenPoint> project_all(const DrawnSurface& surface, const Camera& camera);

}
