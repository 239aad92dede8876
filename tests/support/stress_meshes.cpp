#include "tests/support/stress_meshes.h"

#include <array>
#include <cmath>
#include <random>

#include "tests/support/drilled_plate.h"

namespace geodesic::test {

namespace {

// Random numbers are drawn in statements of their own or between braces: compilers evaluate the arguments
// of a call in any order, and every compiler shall make the same mesh of a seed.

uint32_t between(std::mt19937_64& random, uint32_t least, uint32_t most) {
    return static_cast<uint32_t>(least + random() % (most - least + 1));
}

Soup slivers(std::mt19937_64& random) {
    // Angles down to about 1e-6: a triangulation squeezed in one direction.
    const double squeeze = std::pow(10, uniform(random, -5.5, -1));
    return scaled(delaunay_square(60, random()), 1, squeeze, 1);
}

Soup needle_fan(std::mt19937_64& random) {
    const uint32_t count = between(random, 100, 299);
    const auto rays = cone_rays(count, uniform(random, -1.2, 1.2));
    return cone(rays, between(random, 1, 3));
}

// A band of uneven steps, bent at every one.
Soup strip(std::mt19937_64& random) {
    Soup soup;
    double x = 0;
    for (uint32_t i = 0; i < 60; ++i) {
        x += std::pow(10, uniform(random, -3, 0));
        const double z = uniform(random, -1, 1);
        soup.positions.push_back({x, uniform(random, -0.1, 0.1), z});
        soup.positions.push_back({x, 1 + uniform(random, -0.1, 0.1), z});
        if (i == 0) continue;
        const uint32_t a = 2 * i - 2;
        soup.triangles.push_back({a, a + 2, a + 1});
        soup.triangles.push_back({a + 1, a + 2, a + 3});
    }
    return soup;
}

Soup any_torus(std::mt19937_64& random) {
    const uint32_t around = between(random, 8, 27), across = between(random, 4, 15);
    return torus(around, across, 2, uniform(random, 0.05, 1.5));
}

Soup saddle(std::mt19937_64& random) {
    const uint32_t count = 2 * between(random, 2, 11);
    const auto rays = saddle_rays(count, uniform(random, 0.1, 1.3));
    return cone(rays, between(random, 2, 6));
}

Soup any_plate(std::mt19937_64& random) {
    const uint32_t holes = between(random, 2, 4), corners = between(random, 6, 16);
    return drilled_plate(holes, corners, uniform(random, 0.01, 0.3));
}

// Thousands of equal distances, at rest or bent along one line.
Soup regular_grid(std::mt19937_64& random) {
    const uint32_t width = between(random, 6, 19), height = between(random, 6, 19);
    Soup soup = grid(width, height, 1, 1);
    if (random() % 2 == 0)
        for (auto& p : soup.positions) p.z() = std::abs(p.x() - 0.5);
    return soup;
}

Soup bumpy(std::mt19937_64& random) {
    const uint32_t subdivisions = between(random, 1, 2);
    return bumpy_sphere(subdivisions, random());
}

Soup mixed_winding(std::mt19937_64& random) {
    const Soup sphere = bumpy_sphere(2, random());
    return with_mixed_winding(sphere, random());
}

Soup any_moebius(std::mt19937_64& random) { return moebius(between(random, 16, 25), 3); }
Soup any_pinched(std::mt19937_64& random) { return pinched_sheets(between(random, 3, 4)); }
Soup any_comb(std::mt19937_64& random) { return comb(between(random, 1, 2)); }

constexpr StressFamily MANIFOLD[] = {
    {"slivers", slivers}, {"needle fan", needle_fan},     {"strip", strip}, {"torus", any_torus},
    {"saddle", saddle},   {"regular grid", regular_grid}, {"bumpy", bumpy}, {"plate", any_plate}};

constexpr StressFamily UNORIENTABLE[] = {
    {"mixed winding", mixed_winding}, {"moebius", any_moebius}, {"pinched", any_pinched}, {"comb", any_comb}};

}

Soup scaled(Soup soup, double x, double y, double z) {
    for (auto& p : soup.positions) p = p.cwiseProduct(Eigen::Vector3d(x, y, z));
    return soup;
}

std::span<const StressFamily> stress_families() { return MANIFOLD; }
std::span<const StressFamily> unorientable_families() { return UNORIENTABLE; }

}
