#include "tools/picture/camera.h"

#include <limits>
#include <numbers>

namespace geodesic::tools {

namespace {

// Of the viewer from the centre, in radii of the mesh: a lens of 35 degrees or so.
constexpr double VIEWER_DISTANCE = 3.4;

Vec3 direction(double azimuth, double elevation) {
    const double a = azimuth * std::numbers::pi / 180;
    const double e = elevation * std::numbers::pi / 180;
    return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

// Turns a direction given for y up by exchanging the axes in a circle.
Vec3 turned(Vec3 v, UpAxis up) {
    switch (up) {
    case UpAxis::x:
        return {v.y, v.z, v.x};
    case UpAxis::z:
        return {v.z, v.x, v.y};
    default:
        return v;
    }
}

Camera aimed_camera(const View& view) {
    Camera camera;
    camera.perspective = view.perspective;
    camera.back = turned(direction(view.azimuth, view.elevation), view.up);
    camera.right = turned(direction(view.azimuth + 90, 0), view.up);
    camera.up = cross(camera.back, camera.right);
    return camera;
}

}

ScreenPoint Camera::project(Vec3 position) const {
    const double depth = perspective ? VIEWER_DISTANCE - dot(back, position) : 1;
    const double nearness = perspective ? 1 / depth : dot(back, position);
    return {scale * dot(right, position) / depth + shift_x, shift_y - scale * dot(up, position) / depth,
            nearness};
}

Camera fitted_camera(const DrawnSurface& surface, const View& view, double width, double height,
                     double margin) {
    Camera camera = aimed_camera(view);
    constexpr double HUGE_NUMBER = std::numeric_limits<double>::max();
    double left = HUGE_NUMBER, top = HUGE_NUMBER, right = -HUGE_NUMBER, bottom = -HUGE_NUMBER;
    for (const auto& triangle : surface.triangles)
        for (const uint32_t v : triangle) {
            const ScreenPoint point = camera.project(surface.positions[v]);
            left = std::min(left, point.x);
            right = std::max(right, point.x);
            top = std::min(top, point.y);
            bottom = std::max(bottom, point.y);
        }
    const double free = 1 - 2 * margin;
    constexpr double TINY = 1e-9; // of a mesh seen edge-on
    camera.scale =
        std::min(free * width / std::max(right - left, TINY), free * height / std::max(bottom - top, TINY));
    camera.shift_x = width / 2 - camera.scale * (left + right) / 2;
    camera.shift_y = height / 2 - camera.scale * (top + bottom) / 2;
    return camera;
}

Camera magnified(Camera camera, double factor) {
    camera.scale *= factor;
    camera.shift_x *= factor;
    camera.shift_y *= factor;
    return camera;
}

std::vector<ScreenPoint> project_all(const DrawnSurface& surface, const Camera& camera) {
    std::vector<ScreenPoint> points;
    points.reserve(surface.positions.size());
    for (const Vec3& position : surface.positions) points.push_back(camera.project(position));
    return points;
}

}
