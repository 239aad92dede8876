#include "tools/picture/rasterizer.h"

namespace geodesic::tools {

namespace {

struct PixelRange {
    int begin;
    int end;
};

// The pixels of 0 .. limit - 1 whose centres lie in [low, high].
PixelRange pixels_between(double low, double high, int first, int limit) {
    const double begin = std::clamp(std::ceil(low - 0.5), double(first), double(limit));
    const double end = std::clamp(std::floor(high - 0.5) + 1, double(first), double(limit));
    return {static_cast<int>(begin), static_cast<int>(end)};
}

void rasterize_row(const ScreenTriangle& triangle, uint32_t id, int y, PixelRange columns,
                   VisibilityBuffer& buffer) {
    // On the border between two triangles a pixel must not be missed for rounding.
    constexpr double TOLERANCE = -1e-9;
    for (int x = columns.begin; x < columns.end; ++x) {
        const auto w = triangle.weights(x + 0.5, y + 0.5);
        if (w[0] < TOLERANCE || w[1] < TOLERANCE || w[2] < TOLERANCE) continue;
        const auto nearness =
            static_cast<float>(w[0] * triangle.corners[0].nearness + w[1] * triangle.corners[1].nearness +
                               w[2] * triangle.corners[2].nearness);
        const size_t at = buffer.at(x, y);
        if (nearness <= buffer.nearness[at]) continue;
        buffer.nearness[at] = nearness;
        buffer.triangle[at] = id;
    }
}

}

VisibilityBuffer::VisibilityBuffer(int width_, int first_row_, int row_count_)
    : width(width_), first_row(first_row_), row_count(row_count_),
      nearness(static_cast<size_t>(width_) * static_cast<size_t>(row_count_),
               -std::numeric_limits<float>::infinity()),
      triangle(nearness.size(), NO_TRIANGLE) {}

ScreenTriangle::ScreenTriangle(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c)
    : corners{a, b, c}, double_area((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y)),
      weight_per_x{(b.y - c.y) / double_area, (c.y - a.y) / double_area, (a.y - b.y) / double_area},
      weight_per_y{(c.x - b.x) / double_area, (a.x - c.x) / double_area, (b.x - a.x) / double_area} {}

std::array<double, 3> ScreenTriangle::weights(double x, double y) const {
    const double dx = x - corners[0].x;
    const double dy = y - corners[0].y;
    const double b = weight_per_x[1] * dx + weight_per_y[1] * dy;
    const double c = weight_per_x[2] * dx + weight_per_y[2] * dy;
    return {1 - b - c, b, c};
}

void rasterize(const DrawnSurface& surface, std::span<const ScreenPoint> points, VisibilityBuffer& buffer) {
    for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
        const auto& [ia, ib, ic] = surface.triangles[t];
        const ScreenPoint& a = points[ia];
        const ScreenPoint& b = points[ib];
        const ScreenPoint& c = points[ic];
        const PixelRange rows = pixels_between(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}),
                                               buffer.first_row, buffer.first_row + buffer.row_count);
        if (rows.begin >= rows.end) continue;
        const PixelRange columns =
            pixels_between(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), 0, buffer.width);
        if (columns.begin >= columns.end) continue;
        const ScreenTriangle triangle(a, b, c);
        if (!triangle.is_visible()) continue;
        for (int y = rows.begin; y < rows.end; ++y) rasterize_row(triangle, t, y, columns, buffer);
    }
}

}
