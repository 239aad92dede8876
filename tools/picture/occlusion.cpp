#include "tools/picture/occlusion.h"

#include <numbers>

#include "tools/picture/rasterizer.h"

namespace geodesic::tools {

namespace {

constexpr int BUFFER_SIDE = 384;
constexpr int DIRECTIONS = 72;

// Points spread evenly over the sphere along a spiral with the golden angle.
View direction_view(int i) {
    View view;
    view.azimuth = i * 180.0 * (3 - std::sqrt(5.0));
    view.elevation = std::asin(1 - (2 * i + 1.0) / DIRECTIONS) * 180 / std::numbers::pi;
    view.perspective = false;
    return view;
}

struct Sums {
    std::vector<float> seen;
    std::vector<float> all;
};

std::vector<Vec3> vertex_normals(const DrawnSurface& surface) {
    std::vector<Vec3> normals(surface.positions.size());
    for (size_t t = 0; t < surface.triangles.size(); ++t)
        for (size_t corner = 0; corner < 3; ++corner)
            normals[surface.triangles[t][corner]] = surface.normals[t][corner];
    return normals;
}

// Weighted with the cosine to the normal. The bias grows where the surface is steep, so that it does not hide
// itself.
void look_from(const DrawnSurface& surface, std::span<const Vec3> normals, const View& view, Sums& sums) {
    const Camera camera = fitted_camera(surface, view, BUFFER_SIDE, BUFFER_SIDE, 0.02);
    const std::vector<ScreenPoint> points = project_all(surface, camera);
    VisibilityBuffer buffer(BUFFER_SIDE, 0, BUFFER_SIDE);
    rasterize(surface, points, buffer);
    for (size_t v = 0; v < points.size(); ++v) {
        const double cosine = std::abs(dot(normals[v], camera.back));
        const double bias = (0.5 + 1.5 / std::max(cosine, 0.1)) / camera.scale;
        const int x = std::clamp(static_cast<int>(points[v].x), 0, BUFFER_SIDE - 1);
        const int y = std::clamp(static_cast<int>(points[v].y), 0, BUFFER_SIDE - 1);
        const bool seen = points[v].nearness + bias > double{buffer.nearness[buffer.at(x, y)]};
        sums.all[v] += static_cast<float>(cosine);
        if (seen) sums.seen[v] += static_cast<float>(cosine);
    }
}

}

std::vector<float> sky_visibility(const DrawnSurface& surface) {
    const std::vector<Vec3> normals = vertex_normals(surface);
    const std::vector<float> zero(surface.positions.size(), 0.0f);
    Sums sums{zero, zero};
    for (int i = 0; i < DIRECTIONS; ++i) look_from(surface, normals, direction_view(i), sums);
    std::vector<float> visibility(zero.size(), 1.0f);
    // Half of the directions are behind a closed surface; a thin sheet may be seen from both sides.
    for (size_t v = 0; v < visibility.size(); ++v)
        if (sums.all[v] > 0) visibility[v] = std::min(1.0f, 2 * sums.seen[v] / sums.all[v]);
    return visibility;
}

}
