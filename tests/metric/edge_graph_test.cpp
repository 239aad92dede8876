#include "src/metric/edge_graph.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "tests/support/meshes.h"
#include "tests/support/oracles.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

std::vector<double> random_costs(const Mesh& mesh, uint64_t seed, bool with_zeros) {
    std::mt19937_64 random(seed);
    std::vector<double> cost(mesh.edges.size());
    // Whole numbers: sums are exact and many paths are equally long.
    for (double& c : cost) c = static_cast<double>(random() % 8 + (with_zeros ? 0 : 1));
    return cost;
}

std::vector<Soup> kinds() {
    return {grid(9, 7, 1, 1),  bumpy_sphere(2, 1), torus(9, 7, 2, 0.5),
            pinched_sheets(2), moebius(9, 3),      joined(cube(2), sphere(1))};
}

}

TEST_CASE("edge graph: lengths as costs, every source, against plain Dijkstra") {
    for (const Soup& soup : kinds()) {
        const Mesh mesh = mesh_of(soup);
        const auto cost = edge_lengths(mesh);
        const auto solver = EdgeGraphMetric(mesh, cost).make_solver();
        for (uint32_t s = 0; s < mesh.vertex_count(); ++s)
            CHECK(largest_relative_difference(
                      field(mesh, *solver, {&s, 1}),
                      plain_dijkstra(mesh.vertex_count(), mesh.edges, cost, {&s, 1})) < 1e-13);
    }
}

TEST_CASE("edge graph: whole costs, also zero, from several sources: equal to plain Dijkstra") {
    for (const Soup& soup : kinds())
        for (bool with_zeros : {false, true}) {
            const Mesh mesh = mesh_of(soup);
            const auto cost = random_costs(mesh, 3, with_zeros);
            const auto solver = EdgeGraphMetric(mesh, cost).make_solver();
            std::mt19937_64 random(4);
            for (size_t count : {1u, 2u, 6u}) {
                std::vector<uint32_t> sources(count);
                for (uint32_t& s : sources) s = static_cast<uint32_t>(random() % mesh.vertex_count());
                const auto d = field(mesh, *solver, sources);
                CHECK(d == plain_dijkstra(mesh.vertex_count(), mesh.edges, cost, sources));
                for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
                    const uint32_t named = solver->nearest(v);
                    if (d[v] == UNREACHABLE) {
                        CHECK(named == NONE);
                        continue;
                    }
                    REQUIRE(named < count);
                    CHECK(plain_dijkstra(mesh.vertex_count(), mesh.edges, cost, {&sources[named], 1})[v] ==
                          d[v]);
                }
            }
        }
}

TEST_CASE("edge graph: stopping at targets or at a radius changes no final distance") {
    for (const Soup& soup : kinds()) {
        const Mesh mesh = mesh_of(soup);
        const auto cost = random_costs(mesh, 5, true);
        const auto solver = EdgeGraphMetric(mesh, cost).make_solver();
        for (uint32_t s = 0; s < mesh.vertex_count(); s += 11) {
            const auto full = plain_dijkstra(mesh.vertex_count(), mesh.edges, cost, {&s, 1});
            for (double radius : {0.0, 2.0, 5.0}) {
                const auto within = field(mesh, *solver, {&s, 1}, {}, radius);
                for (uint32_t v = 0; v < mesh.vertex_count(); ++v)
                    CHECK((full[v] <= radius ? within[v] == full[v] : within[v] >= full[v]));
            }
            const std::vector<uint32_t> targets{0, mesh.vertex_count() - 1, mesh.vertex_count() / 2, 0};
            const auto stopped = field(mesh, *solver, {&s, 1}, targets);
            for (uint32_t t : targets) CHECK(stopped[t] == full[t]);
        }
    }
}
