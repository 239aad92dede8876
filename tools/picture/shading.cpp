#include "tools/picture/shading.h"

namespace geodesic::tools {

namespace {

constexpr Colour INK{0.012, 0.010, 0.025};
constexpr double INK_OPACITY = 0.76;

// Lights in the camera's frame: x to the right, y up, z towards the viewer.
const Vec3 KEY_LIGHT = normalized({-0.42, 0.62, 0.66});
const Vec3 FILL_LIGHT = normalized({0.80, -0.05, 0.55});

// Perspective squeezes far parts, so what is affine on the screen are the weights times the nearness.
std::array<double, 3> weights_on_surface(const ScreenTriangle& triangle, std::array<double, 3> weights) {
    double sum = 0;
    for (size_t corner = 0; corner < 3; ++corner) sum += weights[corner] *= triangle.corners[corner].nearness;
    for (double& weight : weights) weight /= sum;
    return weights;
}

template <class Values>
double interpolated(const Values& values, const std::array<double, 3>& weights) {
    return weights[0] * double{values[0]} + weights[1] * double{values[1]} + weights[2] * double{values[2]};
}

double slope_of(const ScreenTriangle& triangle, const std::array<float, 3>& distances) {
    return std::hypot(interpolated(distances, triangle.weight_per_x),
                      interpolated(distances, triangle.weight_per_y));
}

}

double largest_distance(const DrawnSurface& surface, std::span<const float> distances) {
    float largest = 0;
    for (const auto& triangle : surface.triangles)
        for (const uint32_t v : triangle)
            if (std::isfinite(distances[v])) largest = std::max(largest, distances[v]);
    return double{largest};
}

double line_coverage(const Isolines& lines, double distance, double slope) {
    if (lines.count <= 0 || !(lines.spacing > 0)) return 0;
    const double place = distance / lines.spacing;
    const double line = std::clamp(std::round(place), 1.0, static_cast<double>(lines.count));
    const double pixels = std::abs(place - line) * lines.spacing / std::max(slope, 1e-12 * lines.spacing);
    const double coverage = 1 - smooth_step(lines.width / 2 - 0.5, lines.width / 2 + 0.5, pixels);
    // Where lines come closer to each other than they are wide, as at an outline, they would make a black
    // patch.
    const double pixels_apart = lines.spacing / std::max(slope, 1e-12 * lines.spacing);
    return coverage * smooth_step(1.2 * lines.width, 3.5 * lines.width, pixels_apart);
}

Colour Shader::operator()(uint32_t t, double x, double y) const {
    const auto& corners = scene_.surface.triangles[t];
    const ScreenTriangle triangle(scene_.points[corners[0]], scene_.points[corners[1]],
                                  scene_.points[corners[2]]);
    std::array<double, 3> weights = triangle.weights(x, y);
    if (scene_.camera.perspective) weights = weights_on_surface(triangle, weights);
    std::array<float, 3> distances{};
    std::array<float, 3> sky{};
    Vec3 normal;
    for (size_t corner = 0; corner < 3; ++corner) {
        distances[corner] = scene_.distances[corners[corner]];
        sky[corner] = scene_.sky[corners[corner]];
        normal = normal + weights[corner] * scene_.surface.normals[t][corner];
    }
    const double distance = interpolated(distances, weights);
    const Colour colour = surface_colour(distance, slope_of(triangle, distances));
    return lit(colour, std::isfinite(distance), normal, interpolated(sky, weights));
}

Colour Shader::surface_colour(double distance, double slope) const {
    const Colour colour = colour_map_.of_distance(distance, scene_.max_distance);
    if (!std::isfinite(distance)) return colour;
    return mix(colour, INK, INK_OPACITY * line_coverage(scene_.isolines, distance, slope));
}

Colour Shader::lit(Colour colour, bool reachable, Vec3 normal, double sky) const {
    normal = normalized(normal);
    Vec3 n{dot(normal, scene_.camera.right), dot(normal, scene_.camera.up), dot(normal, scene_.camera.back)};
    if (n.z < 0) n = -1 * n;
    const double open = 0.25 + 0.75 * sky;
    const double ambient = (0.33 + 0.15 * n.y) * open;
    const double key = 0.74 * std::max(0.0, dot(n, KEY_LIGHT)) * (0.45 + 0.55 * sky);
    const double fill = 0.17 * std::max(0.0, dot(n, FILL_LIGHT)) * open;
    const Vec3 halfway = normalized(KEY_LIGHT + Vec3{0, 0, 1});
    const double gloss = 0.07 * std::pow(std::max(0.0, dot(n, halfway)), 48) * sky;
    // Red falls off least: yellow in the shade is to look golden, not olive.
    const double light = ambient + key + fill;
    const double warm = reachable ? std::pow(light, 0.84) : light;
    return {warm * colour.x + gloss, light * colour.y + gloss, light * colour.z + gloss};
}

}
