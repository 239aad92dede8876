#include "tools/picture/source_marks.h"

#include "tools/picture/blend.h"

namespace geodesic::tools {

namespace {

constexpr Colour RIM{0.010, 0.010, 0.022};

double mark_radius(const Image& image, size_t mark_count) {
    const double largest = std::max(3.0, 0.011 * std::min(image.width, image.height));
    return mark_count <= 8 ? largest
                           : std::max(2.5, largest / std::sqrt(static_cast<double>(mark_count) / 8));
}

// A ball lit from the upper left.
Colour ball_colour(double dx, double dy, double distance, double radius) {
    const double light = 0.80 + 0.20 * std::clamp((-dx - dy) / radius, -1.0, 1.0);
    return mix({light, light, light}, RIM, smooth_step(0.68 * radius - 0.5, 0.68 * radius + 0.5, distance));
}

void draw_mark(const ScreenPoint& centre, double radius, Image& image) {
    const int reach = static_cast<int>(std::ceil(radius)) + 2;
    const int middle_x = static_cast<int>(centre.x);
    const int middle_y = static_cast<int>(centre.y);
    for (int y = std::max(0, middle_y - reach); y < std::min(image.height, middle_y + reach + 1); ++y)
        for (int x = std::max(0, middle_x - reach); x < std::min(image.width, middle_x + reach + 1); ++x) {
            const double dx = x + 0.5 - centre.x;
            const double dy = y + 0.5 - centre.y;
            const double distance = std::hypot(dx, dy);
            const double opacity = 1 - smooth_step(radius - 0.75, radius + 0.75, distance);
            if (opacity > 0) blend(image.pixel(x, y), ball_colour(dx, dy, distance, radius), opacity);
        }
}

}

void draw_source_marks(const DrawnSurface& surface, const View& view, const Camera& camera,
                       std::span<const uint32_t> sources, Image& image) {
    const VisibilityTest is_visible(surface, view);
    const double radius = mark_radius(image, sources.size());
    for (const uint32_t source : sources)
        if (is_visible(surface.positions[source]))
            draw_mark(camera.project(surface.positions[source]), radius, image);
}

}
