#include "src/tables/near_distances.h"

#include <set>

#include <doctest/doctest.h>

#include "src/metric/window_propagation.h"
#include "tests/support/meshes.h"
#include "tests/support/oracles.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// Every vertex within the reach is there, with its distance, and no others are but at the rim.
void check_around(const NearDistances& near, uint32_t vertex, std::span<const double> exact) {
    std::set<uint32_t> found;
    for (const auto& [other, distance] : near.of(vertex)) {
        CHECK(found.insert(other).second);
        CHECK(distance == doctest::Approx(exact[other]).epsilon(1e-6));
        CHECK(double{distance} <= 1.000001 * near.reach(vertex));
    }
    for (uint32_t v = 0; v < exact.size(); ++v)
        if (exact[v] > 0 && exact[v] < 0.999999 * near.reach(vertex) && exact[v] < UNREACHABLE)
            CHECK(found.contains(v));
}

}

TEST_CASE("near distances: the nearest vertices, then twice and four times as many") {
    constexpr uint32_t NEAREST = 25;
    for (const Soup& soup : {jittered_grid(16, 1), bumpy_sphere(3, 1), pinched_sheets(6)}) {
        const Mesh mesh = mesh_of(soup);
        const auto solver = ExactMetric(mesh).make_solver();
        NearDistances near(mesh.vertex_count(), NEAREST);
        for (uint32_t v = 0; v < mesh.vertex_count(); v += 7) {
            const auto exact = exact_field(mesh, v);
            CHECK(near.of(v).empty());
            solver->solve(near.with_near(v, {&v, 1}));
            near.take(v, *solver);
            REQUIRE(!near.of(v).empty());
            check_around(near, v, exact);
            for (const uint32_t times : {2u, 4u}) {
                const size_t before = near.of(v).size();
                CHECK(near.wider_count(v) == times * NEAREST);
                near.widen(v, *solver);
                check_around(near, v, exact);
                CHECK((near.of(v).size() > before || near.reach(v) == UNREACHABLE));
                CHECK(near.of(v).size() <= times * NEAREST);
            }
            CHECK(near.wider_count(v) == 0);
        }
    }
}
