// Paths on surfaces of revolution with a row of vertices at a pole that all but coincide: the triangles there
// are needles, around a hole that is hardly one.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "tests/path/walks.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

namespace {

constexpr double PI = std::numbers::pi;

// What modelling tools leave of the sine of pi, by double and by single precision, and what lies between.
constexpr double ROW_RADII[] = {1e-16, 1e-13, 1e-11, 1e-8};

struct Ring {
    double radius, height;
};

// One row of vertices for each ring: vertex ring * sectors + sector.
Soup revolved(const std::vector<Ring>& rings, uint32_t sectors) {
    Soup soup;
    for (const auto& [radius, height] : rings)
        for (uint32_t s = 0; s < sectors; ++s) {
            const double angle = 2 * PI * s / sectors;
            soup.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
        }
    for (uint32_t r = 0; r + 1 < rings.size(); ++r)
        for (uint32_t s = 0; s < sectors; ++s) {
            const uint32_t a = r * sectors + s, b = r * sectors + (s + 1) % sectors, c = a + sectors,
                           d = b + sectors;
            soup.triangles.push_back({a, b, c});
            soup.triangles.push_back({b, d, c});
        }
    return soup;
}

Soup uv_sphere(uint32_t sectors, double pole) {
    std::vector<Ring> rings{{pole, 1}};
    for (uint32_t i = 1; i < sectors; ++i)
        rings.push_back({std::sin(PI * i / sectors), std::cos(PI * i / sectors)});
    rings.push_back({pole, -1});
    return revolved(rings, sectors);
}

// Half spheres on a tube.
Soup capsule(uint32_t sectors, double pole) {
    std::vector<Ring> rings{{pole, 2}};
    for (int i = 1; i <= 4; ++i) rings.push_back({std::sin(PI * i / 8), 1 + std::cos(PI * i / 8)});
    for (int i = 4; i >= 1; --i) rings.push_back({std::sin(PI * i / 8), -1 - std::cos(PI * i / 8)});
    rings.push_back({pole, -2});
    return revolved(rings, sectors);
}

std::vector<Soup> surfaces(double pole) {
    return {uv_sphere(8, pole),
            uv_sphere(12, pole),
            capsule(8, pole),
            revolved({{pole, 2}, {0.5, 1}, {1, 0}}, 9),                                              // cone
            revolved({{pole, 4}, {0.2, 2}, {0.4, 0}}, 24),                                           // spike
            revolved({{pole, 1}, {0.5, 1}, {1, 1}, {1, 0}, {0.5, 0}, {pole, 0}}, 8),                 // can
            revolved({{pole, 0.1}, {1, 0.1}, {1, 0}, {pole, 0}}, 12),                                // coin
            revolved({{pole, 0.2}, {1, 0}, {pole, -0.2}}, 16),                                       // lens
            joined(revolved({{pole, 1}, {0.3, 0.2}, {0.6, 0.1}, {1, 0.5}}, 7), uv_sphere(5, pole))}; // hat
}

// Calls check(on) with each of the surfaces.
template <class Check>
void for_each_surface(const Check& check) {
    for (const double pole : ROW_RADII) {
        if (SANITIZED && pole != ROW_RADII[0]) continue;
        CAPTURE(pole);
        size_t number = 0;
        for (Soup& soup : surfaces(pole)) {
            ++number;
            CAPTURE(number);
            check(PathCase(std::move(soup)));
        }
    }
}

// One in two points lies in a triangle at the pole.
geoidx_surface_point point_near_pole(const PathCase& on, std::mt19937_64& random, size_t turn) {
    auto point = random_point(on.soup, random, turn);
    if (random() % 2 == 0) point.triangle = static_cast<uint32_t>(random() % 16) % 14;
    return point;
}

}

TEST_CASE("coincident vertices: paths are as on any surface") {
    size_t paths = 0, shortest = 0;
    for_each_surface([&](const PathCase& on) {
        std::mt19937_64 random(2);
        for (size_t i = 0; i < 120; ++i) {
            CAPTURE(i);
            const auto from = point_near_pole(on, random, i), to = point_near_pole(on, random, i / 4);
            const double exact = on.exact(from, to);
            if (exact == INFINITY) continue;
            CAPTURE(exact);
            const double straight = path_length(on, from, to, GEOIDX_PATH_STRAIGHT);
            CHECK(straight >= exact * (1 - 1e-9) - 1e-9);
            ++paths;
            shortest += straight <= exact * (1 + 1e-6) + 1e-9;
            const double best = path_length(on, from, to, GEOIDX_PATH_EXACT);
            CHECK(std::abs(best - exact) <= exact * 1e-7 + 1e-9);
        }
    });
    CHECK(shortest >= 0.99 * static_cast<double>(paths));
}

// Cut open and laid flat, a cone is a sector of the plane.
TEST_CASE("coincident vertices: paths around the tip of a cone have the length of lines in the plane") {
    constexpr uint32_t SECTORS = 12;
    const double slant = std::sqrt(1 + 0.25), facet = 2 * std::asin(std::sin(PI / SECTORS) / slant);
    for (const double pole : ROW_RADII) {
        CAPTURE(pole);
        const PathCase on(revolved({{pole, 0.5}, {0.5, 0.25}, {1, 0}}, SECTORS));
        const auto at = [&](uint32_t sector) { return corner(2 * SECTORS + 2 * (sector % SECTORS), 2); };
        for (uint32_t from = 0; from < SECTORS; ++from)
            for (uint32_t steps = 1; steps < SECTORS; ++steps) {
                CAPTURE(from);
                CAPTURE(steps);
                const double angle = std::min(steps, SECTORS - steps) * facet;
                const double expected = angle < PI ? 2 * slant * std::sin(angle / 2) : 2 * slant;
                for (const uint32_t quality : {GEOIDX_PATH_STRAIGHT, GEOIDX_PATH_EXACT})
                    CHECK(std::abs(path_length(on, at(from), at(from + steps), quality) - expected) < 1e-7);
            }
    }
}

TEST_CASE("coincident vertices: walks are as long as paths") {
    for_each_surface([](const PathCase& on) {
        std::mt19937_64 random(3);
        for (size_t i = 0; i < 12; ++i) {
            CAPTURE(i);
            const auto from = point_near_pole(on, random, i), to = point_near_pole(on, random, i / 4);
            if (on.exact(from, to) == INFINITY) continue;
            const double straight = path_length(on, from, to, GEOIDX_PATH_STRAIGHT);
            for (const double share : {1.0, 0.6})
                CHECK(walk(on, from, to, share) <= straight * (1 + 1e-9) + CLOSE);
        }
    });
}

// Distances are multiples of a small step, below which two vertices may lie.
TEST_CASE("coincident vertices: distances of vertices") {
    for_each_surface([](const PathCase& on) {
        geoidx_info info{};
        info.struct_size = sizeof(info);
        REQUIRE(geoidx_get_info(on.index.get(), &info) == GEOIDX_OK);
        const uint32_t count = on.soup.vertex_count();
        std::vector<uint32_t> all(count);
        std::iota(all.begin(), all.end(), 0);
        std::vector<double> exact(count);
        std::vector<float> field(count);
        for (uint32_t source = 0; source < count; source += 5) {
            CAPTURE(source);
            require_success(
                geoidx_solver_distances(on.solver.get(), &source, 1, all.data(), count, exact.data()));
            require_success(geoidx_query_msad(on.query.get(), &source, 1, field.data(), count));
            for (uint32_t v = 0; v < count; ++v) {
                CAPTURE(v);
                float pair = 0;
                require_success(geoidx_query_sssd(on.query.get(), source, v, &pair));
                for (const double found : {double{field[v]}, double{pair}})
                    if (exact[v] == INFINITY)
                        CHECK(found == INFINITY);
                    else
                        CHECK(std::abs(found - exact[v]) <= 0.03 * exact[v] + 2 * info.largest_step);
            }
        }
    });
}
