// Where ways cross an edge to a target of which only distances are known.
#include "src/path/edge_crossing.h"

#include <doctest/doctest.h>

#include "tests/support/surfaces.h"

using namespace geodesic;
using namespace geodesic::test;

TEST_CASE("edge crossing: of an edge without length the nearer end counts") {
    Soup soup;
    soup.positions = {{0, 0, 0}, {0, 0, 0}, {0, 1, 0}};
    soup.triangles = {{0, 1, 2}};
    const Surface surface = surface_of(soup);
    CHECK(cross_edge(surface, 0, 1, {1, 1, 0}, 3, 2).rest == 2);
    CHECK(cross_edge(surface, 0, 1, {1, 1, 0}, 2, 3).rest == 2);
}

TEST_CASE("edge crossing: in a plane the way is straight") {
    Soup soup;
    soup.positions = {{0, 0, 0}, {4, 0, 0}, {0, 1, 0}};
    soup.triangles = {{0, 1, 2}};
    const Surface surface = surface_of(soup);
    const Eigen::Vector3d from(1, 1, 0), target(2, -3, 0);
    const EdgeCrossing crossing =
        cross_edge(surface, 0, 1, from, target.norm(), (target - Eigen::Vector3d(4, 0, 0)).norm());
    CHECK(crossing.share == doctest::Approx(1.25 / 4));
    CHECK(crossing.rest == doctest::Approx((target - from).norm() * 3 / 4));
}
