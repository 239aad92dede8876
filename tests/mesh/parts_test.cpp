#include "src/mesh/parts.h"

#include <cmath>
#include <set>

#include <doctest/doctest.h>

#include "tests/support/meshes.h"

using namespace geodesic;
using namespace geodesic::test;

TEST_CASE("parts: how many edges across, each by itself") {
    const auto across = [](const Soup& soup) { return edges_across_parts(mesh_of(soup)); };
    const auto all_are = [](const std::vector<uint8_t>& of_vertex, uint8_t expected) {
        return std::set(of_vertex.begin(), of_vertex.end()) == std::set{expected};
    };
    // Edges of 1, 1 and the square root of 2, as many of each but at the rim.
    const Soup sheet = grid(30, 30, 30, 30);
    const double average = (2 * 30 * 31 + 30 * 30 * std::sqrt(2)) / (2 * 30 * 31 + 30 * 30);
    CHECK(all_are(across(sheet), static_cast<uint8_t>(30 * std::sqrt(2) / average)));
    CHECK(all_are(across(grid(30, 30, 3e-8, 3e-8)), static_cast<uint8_t>(30 * std::sqrt(2) / average)));
    CHECK(all_are(across(grid(1, 1, 1, 1)), 1));
    CHECK(all_are(across(grid(400, 2, 400, 2)), 255));

    Soup far = grid(1, 1, 1, 1);
    for (Eigen::Vector3d& at : far.positions) at.x() += 1e6;
    const Soup both = joined(sheet, far);
    const auto of_both = across(both);
    const auto of_sheet = across(sheet);
    for (uint32_t v = 0; v < both.vertex_count(); ++v)
        CHECK(of_both[v] == (both.positions[v].x() > 1e5 ? 1 : of_sheet.front()));
}
