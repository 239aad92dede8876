#include "tools/picture/way_line.h"

#include <algorithm>
#include <cmath>

#include "tools/picture/blend.h"

namespace geodesic::tools {

namespace {

constexpr Colour RIM{0.010, 0.010, 0.022}, LINE{1, 1, 1};

Vec3 position_of(const DrawnSurface& surface, const WayPoint& point) {
    Vec3 position;
    for (size_t k = 0; k < 3; ++k)
        position = position + point.weights[k] * surface.positions[point.corners[k]];
    return position;
}

// How much of each pixel a line of a width covers. It is drawn as discs side by side, of which each pixel
// takes the largest share.
class Cover {
public:
    Cover(const Image& image, double radius)
        : image_(image), radius_(radius),
          shares_(static_cast<size_t>(image.width) * static_cast<size_t>(image.height)) {}

    void add_disc(const ScreenPoint& centre) {
        const int reach = static_cast<int>(std::ceil(radius_)) + 1;
        const int middle_x = static_cast<int>(centre.x), middle_y = static_cast<int>(centre.y);
        for (int y = std::max(0, middle_y - reach); y < std::min(image_.height, middle_y + reach + 1); ++y)
            for (int x = std::max(0, middle_x - reach); x < std::min(image_.width, middle_x + reach + 1);
                 ++x) {
                const double distance = std::hypot(x + 0.5 - centre.x, y + 0.5 - centre.y);
                const double share = 1 - smooth_step(radius_ - 0.75, radius_ + 0.75, distance);
                float& most = shares_[at(x, y)];
                most = std::max(most, static_cast<float>(share));
            }
    }

    void paint(Colour colour, Image& image) const {
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                if (const float share = shares_[at(x, y)]; share > 0)
                    blend(image.pixel(x, y), colour, double{share});
    }

private:
    size_t at(int x, int y) const {
        return static_cast<size_t>(y) * static_cast<size_t>(image_.width) + static_cast<size_t>(x);
    }

    const Image& image_;
    const double radius_;
    std::vector<float> shares_;
};

// Calls use(position) for points along a path, half a pixel or less from each other.
template <class Use>
void for_each_position(const DrawnSurface& surface, const Camera& camera, std::span<const WayPoint> way,
                       const Use& use) {
    for (size_t i = 0; i + 1 < way.size(); ++i) {
        const Vec3 begin = position_of(surface, way[i]), end = position_of(surface, way[i + 1]);
        const ScreenPoint a = camera.project(begin), b = camera.project(end);
        const int steps = 1 + static_cast<int>(2 * std::hypot(b.x - a.x, b.y - a.y));
        for (int k = 0; k <= steps; ++k) use(mix(begin, end, static_cast<double>(k) / steps));
    }
}

}

void draw_way(const DrawnSurface& surface, const View& view, const Camera& camera,
              std::span<const WayPoint> way, Image& image) {
    if (way.empty()) return;
    const VisibilityTest is_visible(surface, view);
    const double radius = std::max(1.5, 0.003 * std::min(image.width, image.height));
    Cover rim(image, 1.6 * radius), line(image, radius);
    for_each_position(surface, camera, way, [&](Vec3 position) {
        if (!is_visible(position)) return;
        rim.add_disc(camera.project(position));
        line.add_disc(camera.project(position));
    });
    rim.paint(RIM, image);
    line.paint(LINE, image);
}

}
