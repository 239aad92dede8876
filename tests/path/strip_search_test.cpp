// Searches that are given up.
#include <doctest/doctest.h>

#include "src/path/strip_search.h"
#include "src/surface/nearby.h"
#include "tests/support/surfaces.h"

using namespace geodesic;

TEST_CASE("strip search: gives up after as many steps as it may take") {
    constexpr uint32_t CELLS = 20;
    const Surface surface = test::surface_of(test::grid(CELLS, CELLS, 1, 1));
    const SurfacePoint source{0, {0.3, 0.3, 0.4}}, target{2 * CELLS * CELLS - 1, {0.2, 0.5, 0.3}};
    const Eigen::Vector3d goal = position_of(surface, target);
    TargetDistances distances{[&](uint32_t vertex) { return (surface.positions[vertex] - goal).norm(); }};
    const auto found = search_strip(surface, source, target, distances);
    REQUIRE(found);
    size_t enough = 0;
    do distances.most_steps = ++enough;
    while (!search_strip(surface, source, target, distances) && enough < 10 * found->faces.size());
    // Each face of the strip is left once, and so may some beside it be.
    CHECK(enough >= found->faces.size());
    CHECK(enough <= surface.face_count());
    const auto again = search_strip(surface, source, target, distances);
    REQUIRE(again);
    CHECK(again->faces == found->faces);
}
