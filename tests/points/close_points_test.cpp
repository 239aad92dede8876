// Distances of points of the surface that are near each other, or near a vertex.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/mesh/angle.h"
#include "tests/points/point_cases.h"
#include "tests/support/sanitized.h"

using geodesic::angle_between;
using namespace geodesic::test;

namespace {

// A plane, cut badly and rolled up: edges on both sides of a vertex lie on one line.
Soup swiss_roll() {
    Soup soup = with_random_diagonals(grid(150, 10, 1, 3), 1, 1);
    for (auto& at : soup.positions) {
        const double turned = 4 * std::numbers::pi * at.x() + 1;
        at = {turned * std::cos(turned), at.y(), turned * std::sin(turned)};
    }
    return soup;
}

// A wall with two shelves through it, all cut into squares of one unit: where they meet, edges have four
// triangles.
Soup wall_with_shelves() {
    constexpr uint32_t SIDE = 12;
    const Soup wall = grid(SIDE, SIDE, SIDE, SIDE);
    Soup all = wall;
    for (const double height : {4.0, 8.0}) {
        Soup shelf = wall;
        for (Eigen::Vector3d& at : shelf.positions) at = {at.x(), height, at.y() - 6};
        const auto first = static_cast<uint32_t>(all.positions.size());
        all.positions.insert(all.positions.end(), shelf.positions.begin(), shelf.positions.end());
        for (const auto& [a, b, c] : shelf.triangles)
            all.triangles.push_back({first + a, first + b, first + c});
    }
    return all;
}

// Straight over the unfolded faces or, where these fill half a turn or more on both sides, over the apex.
double distance_on_cone(double total, double at_a, double at_b, double from_a, double from_b) {
    const double between = std::abs(at_a - at_b), turned = std::min(between, total - between);
    if (turned >= std::numbers::pi) return from_a + from_b;
    return std::hypot(from_a - from_b, 2 * std::sqrt(from_a * from_b) * std::sin(turned / 2));
}

}

TEST_CASE("points: straight within a triangle and over an edge of two") {
    const PathCase on(bumpy_sphere(3, 8));
    std::mt19937_64 random(4);
    for (uint32_t t = 0; t < on.soup.triangles.size(); t += 5) {
        auto a = random_point(on.soup, random, 0), b = random_point(on.soup, random, 0);
        a.triangle = b.triangle = t;
        CHECK(on.sssd(a, b) == doctest::Approx((on.position(a) - on.position(b)).norm()).epsilon(1e-6));
        CHECK(on.sssd(a, a) == 0);
        const auto middle = [](uint32_t triangle) {
            return geoidx_surface_point{triangle, 0, {1. / 3, 1. / 3, 1. / 3}};
        };
        for (uint32_t other = 0; other < on.soup.triangles.size(); ++other) {
            size_t shared = 0;
            for (const uint32_t v : on.soup.triangles[t])
                shared += static_cast<size_t>(std::ranges::count(on.soup.triangles[other], v));
            if (shared != 2) continue;
            const double exact = on.exact(middle(t), middle(other));
            CHECK(on.sssd(middle(t), middle(other)) == doctest::Approx(exact).epsilon(2e-3));
        }
    }
}

// Borders of leaves run along such edges, where a leaf has only some of the faces.
TEST_CASE("points: near ones beside edges of several triangles") {
    const PathCase on(wall_with_shelves(), default_options());
    std::mt19937_64 random(13);
    const auto around = triangles_around_vertices(on.soup);
    double worst = 0;
    for (size_t i = 0; i < 3000; i += sparse(1)) {
        const auto a = random_point(on.soup, random, 0);
        uint32_t triangle = a.triangle;
        for (size_t step = 0; step < 2; ++step) {
            const auto& there = around[on.soup.triangles[triangle][random() % 3]];
            triangle = there[random() % there.size()];
        }
        auto b = random_point(on.soup, random, 0);
        b.triangle = triangle;
        const double exact = on.exact(a, b);
        if (exact > 0.1) worst = std::max(worst, std::abs(on.sssd(a, b) / exact - 1));
    }
    CHECK(worst < 0.1);
}

// Three faces around a vertex on the boundary, which turns away from the straight line behind the next one.
TEST_CASE("points: from a vertex nothing is seen past a corner of the boundary") {
    const PathCase on(Soup{{{0, 0, 0}, {0.5, 1, 0.1}, {-1, 1, 0}, {1, 0, 0}, {2, -1, 0.1}},
                           {{0, 1, 2}, {0, 3, 1}, {3, 4, 1}}},
                      default_options());
    for (const geoidx_surface_point& vertex :
         {geoidx_surface_point{0, 0, {1, 0, 0}}, geoidx_surface_point{1, 0, {1, 0, 0}}})
        for (const double share : {0.7, 0.9, 0.99}) {
            const geoidx_surface_point beyond{2, 0, {0.9 * (1 - share), share, 0.1 * (1 - share)}};
            CHECK(on.sssd(vertex, beyond) == doctest::Approx(on.exact(vertex, beyond)).epsilon(1e-3));
            CHECK(on.sssd(beyond, vertex) == on.sssd(vertex, beyond));
        }
}

// The line between two such points often passes through an end of an edge that two triangles share.
TEST_CASE("points: near ones on edges are symmetric" * doctest::skip(SANITIZED)) {
    for (const Soup& soup : {swiss_roll(), torus(24, 12, 1, 0.4)}) {
        const PathCase on(soup);
        const auto around = triangles_around_vertices(soup);
        std::mt19937_64 random(1);
        for (size_t i = 0; i < 5000; ++i) {
            const auto a = random_edge_point(random, static_cast<uint32_t>(random() % soup.triangles.size()));
            const auto& nearby = around[soup.triangles[a.triangle][random() % 3]];
            const auto b = random_edge_point(random, nearby[random() % nearby.size()]);
            CHECK(on.sssd(a, b) == on.sssd(b, a));
        }
    }
}

TEST_CASE("points: near a common vertex they are no farther apart than the way over it is long" *
          doctest::skip(SANITIZED)) {
    for (const uint32_t metric : {GEOIDX_METRIC_EXACT, GEOIDX_METRIC_EDGES})
        for (const uint32_t engine : {GEOIDX_ENGINE_OVERLAY, GEOIDX_ENGINE_GRAPH})
            for (const Soup& soup : {sphere(3), pinched_sheets(4), cone(saddle_rays(10, 0.9), 4)}) {
                const PathCase on(soup, path_options(engine, metric));
                const auto around = triangles_around_vertices(soup);
                std::mt19937_64 random(3);
                for (size_t i = 0; i < 600; ++i) {
                    const auto vertex = static_cast<uint32_t>(random() % soup.vertex_count());
                    const auto point = [&] {
                        const uint32_t triangle = around[vertex][random() % around[vertex].size()];
                        return point_near(soup, random, vertex, triangle, std::pow(0.1, i % 7));
                    };
                    const auto a = point(), b = point();
                    CAPTURE(i);
                    const double bent = (on.position(a) - soup.positions[vertex]).norm() +
                                        (on.position(b) - soup.positions[vertex]).norm();
                    CHECK(double{on.sssd(a, b)} <= bent * (1 + 1e-6));
                    CHECK(on.sssd(a, b) == on.sssd(b, a));
                }
            }
}

TEST_CASE("points: near the apex of a cone they are no farther apart than unfolded") {
    for (const uint32_t engine : {GEOIDX_ENGINE_OVERLAY, GEOIDX_ENGINE_GRAPH})
        for (const auto& rays : {cone_rays(3, 1.1), cone_rays(4, 0.5), cone_rays(7, 1.1), cone_rays(40, 0.3),
                                 cone_rays(200, 0.8), saddle_rays(10, 0.9)}) {
            auto options = path_options();
            options.engine = engine;
            const PathCase on(cone(rays, 4), options);
            const double step = angle_between(rays[0], rays[1]),
                         total = step * static_cast<double>(rays.size());
            const auto around = triangles_around_vertices(on.soup)[0];
            // How far around the apex a point is: triangle k lies between the rays k and k + 1.
            const auto turned = [&](const geoidx_surface_point& point) {
                const auto k =
                    static_cast<size_t>(std::ranges::find(around, point.triangle) - around.begin());
                return step * static_cast<double>(k) + angle_between(rays[k], on.position(point));
            };
            std::mt19937_64 random(5);
            for (size_t i = 0; i < 600; ++i) {
                const auto point = [&] {
                    return point_near(on.soup, random, 0, around[random() % around.size()],
                                      std::pow(0.1, 1 + i % 6));
                };
                const auto a = point(), b = point();
                CAPTURE(i);
                const double exact = distance_on_cone(total, turned(a), turned(b), on.position(a).norm(),
                                                      on.position(b).norm());
                CHECK(double{on.sssd(a, b)} <= exact * (1 + 1e-6));
                CHECK(on.sssd(a, b) == on.sssd(b, a));
            }
        }
}

// Around a corner, nothing goes on over an edge of three triangles.
TEST_CASE("points: near a common vertex of surfaces they are not too far apart" * doctest::skip(SANITIZED)) {
    for (const Soup& soup : {sphere(3), torus(24, 12, 1, 0.4), moebius(20, 3), pinched_sheets(3),
                             with_mixed_winding(bumpy_sphere(3, 9), 4)}) {
        const PathCase on(soup);
        const auto around = triangles_around_vertices(soup);
        std::mt19937_64 random(7);
        for (size_t i = 0; i < 600; ++i) {
            const auto vertex = static_cast<uint32_t>(random() % soup.vertex_count());
            const auto point = [&] {
                const uint32_t triangle = around[vertex][random() % around[vertex].size()];
                return point_near(soup, random, vertex, triangle, std::pow(0.1, 3 + i % 4));
            };
            const auto a = point(), b = point();
            CAPTURE(i);
            CHECK(double{on.sssd(a, b)} <= on.exact(a, b) * (1 + 1e-6));
        }
    }
}

// No way leads over an edge with one face, so that distances of corners from both sides of the hole unfold to
// nothing.
TEST_CASE("points: not through a hole that is a triangle") {
    Soup soup;
    for (const auto& [x, y] :
         {std::pair(1, 0), {1, 1}, {0, 1}, {2, 1}, {0, 2}, {1, 2}, {2, 2}, {1, 3}, {2, 3}})
        soup.positions.emplace_back(x, y, 0);
    soup.triangles = {{0, 1, 2}, {0, 3, 1}, {2, 1, 4}, {1, 5, 4}, {3, 6, 5}, {4, 5, 7}, {5, 6, 8}, {5, 8, 7}};
    for (const uint32_t engine : {GEOIDX_ENGINE_OVERLAY, GEOIDX_ENGINE_GRAPH}) {
        CAPTURE(engine);
        const PathCase on(soup, path_options(engine));
        const geoidx_surface_point a{4, 0, {0.5, 0, 0.5}}, b{1, 0, {0.02, 0.49, 0.49}};
        const double exact = on.exact(a, b);
        CHECK(std::abs(double{on.sssd(a, b)} - exact) <= 0.02 * exact);
        const auto from_a = field(on, std::span(&a, 1)), from_b = field(on, std::span(&b, 1));
        const auto exact_a = on.exact_field(a), exact_b = on.exact_field(b);
        for (size_t v = 0; v < exact_a.size(); ++v) {
            CHECK(std::abs(double{from_a[v]} - exact_a[v]) <= 0.02 * exact_a[v]);
            CHECK(std::abs(double{from_b[v]} - exact_b[v]) <= 0.02 * exact_b[v]);
        }
    }
}
