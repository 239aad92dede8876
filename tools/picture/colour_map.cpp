#include "tools/picture/colour_map.h"

#include <array>
#include <numbers>

namespace geodesic::tools {

namespace {

struct ControlPoint {
    double lightness;
    double chroma;
    double hue; // degrees in Oklab's a-b plane
};

constexpr std::array<ControlPoint, 6> CURVE{{{0.945, 0.095, 102},
                                             {0.855, 0.145, 80},
                                             {0.735, 0.165, 46},
                                             {0.605, 0.185, 10},
                                             {0.465, 0.165, -42},
                                             {0.335, 0.125, -84}}};

// Oklab (Ottosson 2020): a cube root of cone responses, then a rotation.
Colour linear_from_oklab(Vec3 lab) {
    const double l = std::pow(lab.x + 0.3963377774 * lab.y + 0.2158037573 * lab.z, 3);
    const double m = std::pow(lab.x - 0.1055613458 * lab.y - 0.0638541728 * lab.z, 3);
    const double s = std::pow(lab.x - 0.0894841775 * lab.y - 1.2914855480 * lab.z, 3);
    return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
            -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
            -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

Vec3 oklab(const ControlPoint& point) {
    const double hue = point.hue * std::numbers::pi / 180;
    return {point.lightness, point.chroma * std::cos(hue), point.chroma * std::sin(hue)};
}

bool in_gamut(Colour c) { return std::min({c.x, c.y, c.z}) >= 0 && std::max({c.x, c.y, c.z}) <= 1; }

// Less chroma until a screen can show it; lightness and hue stay.
Vec3 into_gamut(Vec3 lab) {
    while (!in_gamut(linear_from_oklab(lab)) && std::hypot(lab.y, lab.z) > 1e-4)
        lab = {lab.x, 0.98 * lab.y, 0.98 * lab.z};
    return lab;
}

// A Catmull-Rom spline through the control points, 0 .. 1.
Vec3 on_curve(double t) {
    constexpr auto LAST = static_cast<double>(CURVE.size() - 1);
    const double place = std::clamp(t, 0.0, 1.0) * LAST;
    const auto i = static_cast<size_t>(std::min(std::floor(place), LAST - 1));
    const double u = place - static_cast<double>(i);
    const Vec3 b = oklab(CURVE[i]);
    const Vec3 c = oklab(CURVE[i + 1]);
    const Vec3 a = i > 0 ? oklab(CURVE[i - 1]) : 2 * b - c;
    const Vec3 d = i + 2 < CURVE.size() ? oklab(CURVE[i + 2]) : 2 * c - b;
    const Vec3 linear = 0.5 * (c - a);
    const Vec3 square = a - 2.5 * b + 2 * c - 0.5 * d;
    const Vec3 cube = 0.5 * (d - a) + 1.5 * (b - c);
    return into_gamut(b + u * (linear + u * (square + u * cube)));
}

}

Colour linear_from_srgb(Colour srgb) {
    const auto linear = [](double v) {
        return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    return {linear(srgb.x), linear(srgb.y), linear(srgb.z)};
}

Colour srgb_from_linear(Colour linear) {
    const auto srgb = [](double v) {
        v = std::clamp(v, 0.0, 1.0);
        return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
    };
    return {srgb(linear.x), srgb(linear.y), srgb(linear.z)};
}

ColourMap::ColourMap() {
    constexpr size_t FINE = 2000;
    constexpr size_t ENTRIES = 256;
    std::vector<Vec3> curve;
    std::vector<double> travelled;
    for (size_t i = 0; i <= FINE; ++i) {
        curve.push_back(on_curve(static_cast<double>(i) / FINE));
        travelled.push_back(i ? travelled.back() + length(curve[i] - curve[i - 1]) : 0);
    }
    size_t i = 0;
    for (size_t entry = 0; entry < ENTRIES; ++entry) {
        const double wanted = travelled.back() * static_cast<double>(entry) / (ENTRIES - 1);
        while (i < FINE && travelled[i] < wanted) ++i;
        table_.push_back(linear_from_oklab(curve[i]));
    }
}

Colour ColourMap::of_distance(double distance, double largest) const {
    if (!std::isfinite(distance)) return UNREACHABLE_COLOUR;
    return (*this)(largest > 0 ? distance / largest : 0);
}

Colour ColourMap::operator()(double t) const {
    const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(table_.size() - 1);
    const size_t i = std::min(static_cast<size_t>(place), table_.size() - 2);
    return mix(table_[i], table_[i + 1], place - static_cast<double>(i));
}

}
