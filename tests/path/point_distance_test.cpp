// Pairs of points where triangles are large for how far the points are apart: tables of vertices say little.
#include <cmath>
#include <numbers>

#include "tests/path/path_cases.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

namespace {

// A closed cylinder with caps that are fans around their middles, and without other vertices on its side.
Soup cylinder(uint32_t sides, double radius, double height) {
    Soup soup;
    for (const double z : {0.0, height})
        for (uint32_t k = 0; k < sides; ++k) {
            const double angle = 2 * std::numbers::pi * k / sides;
            soup.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
        }
    soup.positions.emplace_back(0, 0, 0);
    soup.positions.emplace_back(0, 0, height);
    for (uint32_t k = 0; k < sides; ++k) {
        const uint32_t next = (k + 1) % sides, up = k + sides, next_up = next + sides;
        for (const auto& triangle : {std::array{k, next, next_up}, std::array{k, next_up, up},
                                     std::array{2 * sides, next, k}, std::array{2 * sides + 1, up, next_up}})
            soup.triangles.push_back(triangle);
    }
    return soup;
}

}

// The graph engine may take edges for short where a face is small, and then relies on its vertices.
TEST_CASE("point distance: on disks and columns of few triangles, as the metric says") {
    for (const Soup& soup : {cylinder(64, 5, 1), cylinder(200, 1, 0.02), cylinder(128, 1, 20)})
        for (const auto& [engine, tolerance] :
             {std::pair{GEOIDX_ENGINE_OVERLAY, 0.02}, std::pair{GEOIDX_ENGINE_GRAPH, 0.15}}) {
            const PathCase on(soup, path_options(engine));
            std::mt19937_64 random(6);
            for (size_t i = 0; i < smaller(300, 40); ++i) {
                CAPTURE(i);
                const auto a = random_point(soup, random, 0), b = random_point(soup, random, 0);
                const float distance = on.sssd(a, b);
                CHECK(distance == on.sssd(b, a));
                CHECK(std::abs(double{distance} - on.exact(a, b)) <= tolerance * on.exact(a, b));
            }
        }
}

TEST_CASE("point distance: near points of a rough surface are as far apart as the metric says") {
    const PathCase on(bumpy_sphere(4, 3));
    std::mt19937_64 random(8);
    const auto triangles = static_cast<uint32_t>(on.soup.triangles.size());
    for (uint32_t i = 0; i < smaller(300, 40); ++i) {
        CAPTURE(i);
        // Of two triangles that follow each other in the mesh, mostly near each other.
        auto a = random_point(on.soup, random, 0), b = random_point(on.soup, random, 0);
        b.triangle = (a.triangle + 2) % triangles;
        CHECK(std::abs(double{on.sssd(a, b)} - on.exact(a, b)) <= 0.005 * on.exact(a, b));
    }
}
