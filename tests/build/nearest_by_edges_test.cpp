#include "src/build/nearest_by_edges.h"

#include <algorithm>
#include <initializer_list>

#include <doctest/doctest.h>

#include "tests/support/meshes.h"

using namespace geodesic;
using namespace geodesic::test;

TEST_CASE("nearest by edges: no more than asked for, around the hub of a wheel either") {
    const Mesh mesh = mesh_of(cone(saddle_rays(500, 0.9), 1)); // its apex comes first
    const uint32_t hub[] = {0};
    for (const size_t count : std::initializer_list<size_t>{1, 2, 30, 500, 501, 1000}) {
        auto found = nearest_by_edges(mesh, hub, count);
        CHECK(found.size() == std::min<size_t>(count, mesh.vertex_count()));
        CHECK(found.front() == 0);
        std::ranges::sort(found);
        CHECK(std::ranges::adjacent_find(found) == found.end());
    }
}

TEST_CASE("nearest by edges: those that are given come first, then their neighbours") {
    const Mesh mesh = mesh_of(joined(grid(5, 5, 1, 1), grid(1, 1, 1, 1)));
    const uint32_t corner[] = {0, 0};
    const auto of_corner = nearest_by_edges(mesh, corner, 1 + neighbours(mesh, 0).size());
    CHECK(of_corner.front() == 0);
    for (const uint32_t v : neighbours(mesh, 0)) CHECK(std::ranges::find(of_corner, v) != of_corner.end());
    CHECK(nearest_by_edges(mesh, corner, 1000).size() == 36); // none of the other part
}
