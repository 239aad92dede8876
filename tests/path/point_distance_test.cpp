// Pairs of points where triangles are large for how far the points are apart: tables of vertices say little.
#include <array>
#include <cmath>
#include <numbers>

#include "tests/path/path_cases.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

namespace {

void check_pair(const PathCase& on, const geoidx_surface_point& a, const geoidx_surface_point& b,
                double tolerance) {
    const float distance = on.sssd(a, b);
    CHECK(distance == on.sssd(b, a));
    CHECK(std::abs(double{distance} - on.exact(a, b)) <= tolerance * on.exact(a, b));
}

void check_random_pairs(const PathCase& on, size_t count, double tolerance) {
    std::mt19937_64 random(6);
    for (size_t i = 0; i < count; ++i) {
        CAPTURE(i);
        check_pair(on, random_point(on.soup, random, 0), random_point(on.soup, random, 0), tolerance);
    }
}

}

TEST_CASE("point distance: on disks and columns of few triangles, as the metric says" *
          doctest::skip(SANITIZED)) {
    for (const Soup& soup : {closed_cylinder(64, 0.2), closed_cylinder(200, 0.02), closed_cylinder(128, 20)})
        check_random_pairs(PathCase(soup), 300, 0.02);
}

// Its pairs are by tables alone, which may take edges for short where a face is small.
TEST_CASE("point distance: by the graph engine, symmetric and no shorter than the line in space") {
    for (const Soup& soup : {closed_cylinder(64, 0.2), closed_cylinder(128, 20)}) {
        const PathCase on(soup, path_options(GEOIDX_ENGINE_GRAPH));
        std::mt19937_64 random(6);
        for (size_t i = 0; i < smaller(300, 40); ++i) {
            CAPTURE(i);
            const auto a = random_point(soup, random, 0), b = random_point(soup, random, 0);
            const float distance = on.sssd(a, b);
            CHECK(distance == on.sssd(b, a));
            CHECK(double{distance} >= (on.position(a) - on.position(b)).norm() * (1 - 1e-6));
        }
    }
}

// Tables are rounded to a share of the average edge, of which these are some thousandths.
TEST_CASE("point distance: on a tiny part of a large ground, as the metric says" * doctest::skip(SANITIZED)) {
    constexpr uint32_t CELLS = 40;
    const Soup ground = grid(CELLS, CELLS, 1000, 1000);
    const auto ground_triangles = static_cast<uint32_t>(ground.triangles.size());
    const PathCase on(joined(ground, bumpy_sphere(3, 4)));
    std::mt19937_64 random(6);
    for (size_t i = 0; i < 300; ++i) {
        CAPTURE(i);
        auto a = random_point(on.soup, random, 0), b = random_point(on.soup, random, 0);
        for (auto* const point : {&a, &b})
            point->triangle =
                ground_triangles +
                point->triangle % (static_cast<uint32_t>(on.soup.triangles.size()) - ground_triangles);
        check_pair(on, a, b, 0.005);
    }
}

// Four rings: the outer and the inner wall, and the rims between them.
Soup thin_tube(uint32_t sides, double height, double wall) {
    Soup soup;
    for (uint32_t i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        for (const double radius : {1.0, 1 - wall})
            for (const double z : {0.0, height})
                soup.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
    for (uint32_t i = 0; i < sides; ++i) {
        constexpr std::array<uint32_t, 5> AROUND{0, 1, 3, 2, 0};
        const uint32_t here = 4 * i, next = 4 * ((i + 1) % sides);
        for (size_t k = 0; k < 4; ++k) {
            soup.triangles.push_back({here + AROUND[k], next + AROUND[k], next + AROUND[k + 1]});
            soup.triangles.push_back({here + AROUND[k], next + AROUND[k + 1], here + AROUND[k + 1]});
        }
    }
    return soup;
}

// The ends of edges are near each other over the rims, so that the walls seem to be joined all along.
TEST_CASE("point distance: the two sides of a thin wall are as far apart as the metric says") {
    constexpr uint32_t SIDES = smaller(320, 40);
    auto options = path_options();
    options.target_error = 1;
    const PathCase on(thin_tube(SIDES, 20, 0.02), options);
    std::mt19937_64 random(9);
    for (uint32_t i = 0; i < smaller(60, 20); ++i) {
        CAPTURE(i);
        auto outside = random_point(on.soup, random, 0), inside = random_point(on.soup, random, 0);
        const auto side = static_cast<uint32_t>(random() % SIDES);
        outside.triangle = 8 * side;
        inside.triangle = 8 * ((side + i % 5) % SIDES) + 4;
        check_pair(on, outside, inside, 0.005);
    }
}

// The nearest of some targets, asked for one by one and in one field.
TEST_CASE("point distance: targets on the other side of a thin wall are not the nearest") {
    constexpr uint32_t SIDES = smaller(160, 40), MOST = 4;
    auto options = path_options();
    options.target_error = 1;
    const PathCase on(thin_tube(SIDES, 20, 0.02), options);
    std::mt19937_64 random(4);
    for (const uint32_t count : {12u, smaller(600u, 100u)}) {
        CAPTURE(count);
        auto source = random_point(on.soup, random, 0);
        source.triangle = 0;
        source.weights[0] = source.weights[1] = 0.25; // in the middle between both rims
        source.weights[2] = 0.5;
        std::vector<geoidx_surface_point> targets;
        for (uint32_t i = 0; i < count; ++i) targets.push_back(random_point(on.soup, random, 0));
        for (uint32_t i = 0; i < count; i += 2) targets[i].triangle = 8 * (i % 3) + 4; // on the inner wall
        std::vector<double> exact(count);
        REQUIRE(geoidx_solver_point_distances(on.solver.get(), &source, 1, targets.data(), count,
                                              exact.data()) == GEOIDX_OK);
        std::array<uint32_t, MOST> nearest{};
        std::array<float, MOST> distances{};
        uint32_t found = 0;
        REQUIRE(geoidx_query_point_nearest_targets(on.query.get(), on.surface.get(), &source, targets.data(),
                                                   count, nearest.data(), distances.data(), MOST,
                                                   &found) == GEOIDX_OK);
        REQUIRE(found == MOST);
        std::vector<double> sorted = exact;
        std::ranges::sort(sorted);
        for (size_t k = 0; k < MOST; ++k) {
            CHECK(double{distances[k]} == doctest::Approx(exact[nearest[k]]).epsilon(0.01));
            CHECK(exact[nearest[k]] <= sorted[k] * 1.02);
        }
    }
}

// Straight ways over the caps are not among the shortest ones.
TEST_CASE("point distance: on the caps of a star, as the metric says") {
    Soup star = closed_cylinder(40, 0.3);
    for (uint32_t v = 1; v < star.vertex_count(); v += 2) star.positions[v].head<2>() *= 0.4;
    check_random_pairs(PathCase(star), smaller(3000, 40), 0.005);
}

TEST_CASE("point distance: near points of a rough surface are as far apart as the metric says" *
          doctest::skip(SANITIZED)) {
    const PathCase on(bumpy_sphere(4, 3));
    std::mt19937_64 random(8);
    const auto triangles = static_cast<uint32_t>(on.soup.triangles.size());
    for (uint32_t i = 0; i < 300; ++i) {
        CAPTURE(i);
        // Of two triangles that follow each other in the mesh, mostly near each other.
        const auto a = random_point(on.soup, random, 0);
        auto b = random_point(on.soup, random, 0);
        b.triangle = (a.triangle + 2) % triangles;
        check_pair(on, a, b, 0.005);
    }
}
