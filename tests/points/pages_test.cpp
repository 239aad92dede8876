// Fields from points on pages that meet in a spine: patches meet at its edges, which many triangles share.
#include <cmath>
#include <numbers>

#include "tests/path/path_cases.h"
#include "tests/points/point_cases.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

Soup soup_of(const TestMesh& mesh) {
    Soup soup;
    for (size_t i = 0; i < mesh.positions.size(); i += 3)
        soup.positions.push_back({mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]});
    for (size_t i = 0; i < mesh.triangles.size(); i += 3)
        soup.triangles.push_back({mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]});
    return soup;
}

}

// A way from one page to another crosses the spine between two vertices, neither of which it passes. The
// borders of patches branch there.
TEST_CASE("points: fields of pages lead over each edge of the spine" * doctest::skip(SANITIZED)) {
    for (const uint32_t count : {6u, 10u}) {
        CAPTURE(count);
        const PathCase on(soup_of(pages(count, 5, 8)));
        std::mt19937_64 random(count);
        for (size_t i = 0; i < 80; ++i) {
            const geoidx_surface_point source = random_point(on.soup, random, i % 2 == 0 ? 0 : 3);
            const auto exact = on.exact_field(source);
            const auto answers = field(on, {&source, 1});
            for (uint32_t v = 0; v < on.soup.vertex_count(); ++v)
                CHECK(double{answers[v]} == doctest::Approx(exact[v]).epsilon(0.01));
        }
    }
}

// From a point of the spine all corners are in plain sight, and so is any other point.
TEST_CASE("points: an edge of a thousand triangles") {
    constexpr uint32_t PAGES = 1000;
    Soup soup;
    soup.positions = {{0, 0, 0}, {0, 0, 1}};
    for (uint32_t i = 0; i < PAGES; ++i) {
        const double turned = 2 * std::numbers::pi * i / PAGES;
        soup.positions.push_back({std::cos(turned), std::sin(turned), 0.3});
        soup.triangles.push_back({0, 1, 2 + i});
    }
    const PathCase on(std::move(soup));
    const geoidx_surface_point source{7, 0, {0.4, 0.6, 0}}, of_spine{500, 0, {0.9, 0.1, 0}},
        of_page{900, 0, {0.2, 0.3, 0.5}};
    const auto answers = field(on, {&source, 1});
    for (uint32_t v = 0; v < on.soup.vertex_count(); ++v)
        CHECK(double{answers[v]} ==
              doctest::Approx((on.soup.positions[v] - on.position(source)).norm()).epsilon(1e-6));
    for (const auto& target : {of_spine, of_page}) {
        const double straight = (on.position(source) - on.position(target)).norm();
        CHECK(double{on.sssd(source, target)} == doctest::Approx(straight).epsilon(1e-6));
        CHECK(on.sssd(target, source) == on.sssd(source, target));
    }
}
