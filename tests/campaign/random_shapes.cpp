#include "tests/campaign/random_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace geodesic::campaign {

namespace {

using Eigen::Vector3d;
using test::Soup;

uint32_t side_of(uint32_t vertices) {
    return std::max(1u, static_cast<uint32_t>(std::sqrt(static_cast<double>(vertices))));
}

double cliff(const Vector3d& p) { return std::floor(3 * p.x()) + std::floor(2 * p.y()) > 2 ? 0.8 : 0; }

// A grid with heights: flat, hills, cliffs, or each vertex at random.
Soup terrain(Dice& dice, uint32_t vertices) {
    const double aspect = dice.chance(0.3) ? dice.real(1, 20) : 1;
    const uint32_t rows = std::max(1u, static_cast<uint32_t>(std::sqrt(vertices / aspect)));
    Soup soup = test::grid(std::max(1u, vertices / rows), rows, 1, dice.pick({1.0, 1.0, 0.3}));
    const uint32_t kind = dice.below(4);
    const double height = dice.pick({0.01, 0.2, 1.0});
    for (auto& p : soup.positions)
        p.z() = kind == 0   ? 0
                : kind == 1 ? height * std::sin(9 * p.x()) * std::cos(7 * p.y())
                : kind == 2 ? height * cliff(p)
                            : height * dice.real(0, 1);
    return soup;
}

// Holes, islands, and vertices where fans meet.
Soup riddled(Dice& dice, uint32_t vertices) {
    Soup soup = terrain(dice, vertices);
    const double share = dice.pick({0.05, 0.2, 0.4, 0.6});
    std::erase_if(soup.triangles, [&](const auto&) { return dice.chance(share); });
    if (soup.triangles.empty()) return test::grid(1, 1, 1, 1);
    return soup;
}

Soup ball(Dice& dice, uint32_t vertices) {
    uint32_t subdivisions = 0;
    while (subdivisions < 4 && 4u << 2 * (subdivisions + 1) < vertices) ++subdivisions;
    return dice.chance(0.3) ? test::bumpy_sphere(subdivisions, dice.bits()) : test::sphere(subdivisions);
}

Soup tube(Dice& dice, uint32_t vertices) {
    const uint32_t sides = dice.pick({3u, 4u, 5u, 6u, 8u, 12u});
    const double height = dice.pick({1.0, 10.0, 0.01, 1e-4});
    return test::prism(sides, std::max(1u, vertices / sides), height);
}

Soup ring(Dice& dice, uint32_t vertices) {
    const uint32_t across = dice.pick({3u, 4u, 6u, 10u});
    return test::torus(std::max(3u, vertices / across), across, 1, dice.pick({0.1, 0.3, 0.5}));
}

// Cubes at some places of a lattice: they share corners, edges or whole faces.
Soup boxes(Dice& dice, uint32_t vertices) {
    const uint32_t width = dice.between(2, 4), cells = dice.between(1, 3);
    const uint32_t count = std::clamp(vertices / (6 * cells * cells + 2), 1u, 40u);
    Soup soup;
    for (uint32_t i = 0; i < count; ++i) {
        Soup box = test::cube(cells);
        const uint32_t x = dice.below(width), y = dice.below(width), z = dice.below(width);
        const Vector3d place(x, y, z);
        for (auto& p : box.positions) p += place;
        soup = test::joined(soup, box);
    }
    return soup;
}

// Sheets that share one side.
Soup book(Dice& dice, uint32_t vertices) {
    const uint32_t pages = dice.between(3, 12), side = side_of(vertices / pages);
    Soup soup;
    for (uint32_t page = 0; page < pages; ++page) {
        const double angle = std::numbers::pi * page / pages * dice.pick({1.0, 2.0});
        Soup sheet = test::grid(side, side, 1, 1);
        for (auto& p : sheet.positions) p = {p.x() * std::cos(angle), p.y(), p.x() * std::sin(angle)};
        soup = test::joined(soup, sheet);
    }
    return soup;
}

// Small surfaces that share the vertex at the origin.
Soup bunch(Dice& dice, uint32_t vertices) {
    const uint32_t count = dice.between(2, 7);
    Soup soup;
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t side = side_of(vertices / count);
        Soup sheet = test::grid(side, side, 1, 1);
        const double angle = dice.real(0, 6);
        const Vector3d axis{dice.real(-1, 1), dice.real(-1, 1), 1};
        const Eigen::AngleAxisd turn(angle, axis.normalized());
        for (auto& p : sheet.positions) p = turn * p;
        soup = test::joined(soup, sheet);
    }
    return soup;
}

// Triangles between vertices at random: every way in which they can meet.
Soup tangle(Dice& dice, uint32_t vertices) {
    const bool on_lattice = dice.chance(0.5);
    Soup soup;
    for (uint32_t i = 0; i < vertices; ++i)
        soup.positions.push_back({dice.real(0, 1), dice.real(0, 1), dice.real(0, 1)});
    if (on_lattice)
        for (auto& p : soup.positions) p = (p * 5).array().floor().matrix();
    const uint32_t triangles =
        std::max(1u, static_cast<uint32_t>(vertices * dice.pick({0.3, 0.6, 1.0, 2.0})));
    for (uint32_t t = 0; t < triangles; ++t)
        soup.triangles.push_back({dice.below(vertices), dice.below(vertices), dice.below(vertices)});
    soup.triangles.push_back({0, 1 % vertices, 2 % vertices});
    return soup;
}

Soup needles(Dice& dice, uint32_t vertices) {
    return test::grid(std::max(1u, vertices / 2), 1, dice.pick({1.0, 1e-2, 1e-4, 1e-6}), 1);
}

// One vertex with very many triangles.
Soup hat(Dice& dice, uint32_t vertices) {
    const uint32_t rings = dice.between(1, 4), rays = 2 * std::max(2u, vertices / rings / 2);
    const double slope = dice.real(0, 1.4);
    return test::cone(dice.chance(0.5) ? test::cone_rays(rays, slope) : test::saddle_rays(rays, slope),
                      rings);
}

// The same sheet twice, the second one a little above it or in the very place.
Soup doubled(Dice& dice, uint32_t vertices) {
    const Soup sheet = terrain(dice, vertices / 2 + 2);
    Soup above = sheet;
    const double gap = dice.pick({0.0, 1e-12, 1e-6, 0.01});
    for (auto& p : above.positions) p.z() += gap;
    return test::joined(sheet, above);
}

Soup few(Dice& dice) {
    Soup soup{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, 1}}, {{0, 1, 2}}};
    if (dice.chance(0.5)) soup.triangles = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    return soup;
}

}

Soup random_shape(Dice& dice, uint32_t vertices) {
    vertices = std::max(vertices, 3u);
    switch (dice.below(18)) {
    case 0:
        return riddled(dice, vertices);
    case 1:
        return ball(dice, vertices);
    case 2:
        return tube(dice, vertices);
    case 3:
        return ring(dice, vertices);
    case 4:
        return boxes(dice, vertices);
    case 5:
        return book(dice, vertices);
    case 6:
        return bunch(dice, vertices);
    case 7:
        return tangle(dice, vertices);
    case 8:
        return needles(dice, vertices);
    case 9:
        return hat(dice, vertices);
    case 10:
        return doubled(dice, vertices);
    case 11:
        return few(dice);
    case 12:
        return test::moebius(std::max(3u, vertices / 4), dice.between(1, 4));
    case 13:
        return test::jittered_grid(side_of(vertices), dice.bits());
    case 14:
        return test::delaunay_square(std::min(vertices, 200u), dice.bits());
    case 15:
        return test::comb(std::max(1u, side_of(vertices / 3) / 6));
    default:
        return terrain(dice, vertices);
    }
}

}
