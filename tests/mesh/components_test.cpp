#include "src/mesh/components.h"

#include <cmath>

#include <doctest/doctest.h>

#include "tests/support/meshes.h"

using namespace geodesic;
using namespace geodesic::test;

TEST_CASE("components: how many edges across, each by itself") {
    // Of a mesh in one component, for faces without a longer edge than most.
    const auto across = [](const Soup& soup) {
        const Components components = components_of(mesh_of(soup));
        REQUIRE(components.all.size() == 1);
        return components.of(0).edges_across(0);
    };
    // Edges of 1, 1 and the square root of 2, as many of each but at the rim.
    const Soup sheet = grid(30, 30, 30, 30);
    const double average = (2 * 30 * 31 + 30 * 30 * std::sqrt(2)) / (2 * 30 * 31 + 30 * 30),
                 expected = 30 * std::sqrt(2) / average;
    CHECK(across(sheet) == doctest::Approx(expected));
    CHECK(across(grid(30, 30, 3e-8, 3e-8)) == doctest::Approx(expected));
    CHECK(across(grid(1, 1, 1, 1)) == doctest::Approx(5 * std::sqrt(2) / (4 + std::sqrt(2))));

    Soup far = grid(1, 1, 1, 1);
    for (Eigen::Vector3d& at : far.positions) at.x() += 1e6;
    const Mesh both = mesh_of(joined(sheet, far));
    const Components components = components_of(both);
    CHECK(components.all.size() == 2);
    for (uint32_t v = 0; v < both.vertex_count(); ++v)
        CHECK(components.of(v).edges_across(0) ==
              doctest::Approx(both.positions[v].x() > 1e5 ? across(far) : expected));
}

TEST_CASE("components: a face with a long edge has few of them across") {
    const Component component{100, 1};
    CHECK(component.edges_across(1) == 100);
    CHECK(component.edges_across(2.9) == 100);
    CHECK(component.edges_across(30) == doctest::Approx(10));
    CHECK(component.edges_across(100) == doctest::Approx(3));
}
