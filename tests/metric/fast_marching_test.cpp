#include "src/metric/fast_marching.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "src/metric/edge_graph.h"
#include "tests/support/meshes.h"
#include "tests/support/oracles.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

std::vector<Soup> kinds_to_march() {
    return {jittered_grid(16, 1), bumpy_sphere(3, 1), torus(40, 24, 2, 0.8), prism(12, 20, 6),
            moebius(40, 6),       annulus(30, 6),     pinched_sheets(6)};
}

std::unique_ptr<FieldSolver> marching_over(const Mesh& mesh) {
    return FastMarchingMetric(mesh, edge_lengths(mesh)).make_solver();
}

}

TEST_CASE("fast marching: some percent from the exact distance, and never longer than along edges") {
    for (const Soup& soup : kinds_to_march()) {
        const Mesh mesh = mesh_of(soup);
        const auto lengths = edge_lengths(mesh);
        const auto solver = marching_over(mesh);
        double sum = 0;
        size_t count = 0, far_off = 0;
        for (uint32_t s = 0; s < mesh.vertex_count(); s += 1 + mesh.vertex_count() / 20) {
            const auto marched = field(mesh, *solver, {&s, 1}), exact = exact_field(mesh, s),
                       along_edges = plain_dijkstra(mesh.vertex_count(), mesh.edges, lengths, {&s, 1});
            for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
                REQUIRE((marched[v] == UNREACHABLE) == (exact[v] == UNREACHABLE));
                if (v == s || exact[v] == UNREACHABLE) continue;
                CHECK(marched[v] <= along_edges[v] * (1 + 1e-12));
                const double error = std::abs(marched[v] / exact[v] - 1);
                sum += error;
                far_off += error > 0.1;
                ++count;
            }
        }
        CHECK(sum / static_cast<double>(count) < 0.03);
        CHECK(50 * far_off < count);
    }
}

TEST_CASE("fast marching: the nearest of several sources") {
    for (const Soup& soup : kinds_to_march()) {
        const Mesh mesh = mesh_of(soup);
        const std::vector<uint32_t> sources{0, mesh.vertex_count() / 3, mesh.vertex_count() - 1};
        const auto solver = marching_over(mesh);
        std::vector<std::vector<double>> alone;
        for (const uint32_t s : sources) alone.push_back(field(mesh, *solver, {&s, 1}));
        const auto d = field(mesh, *solver, sources);
        for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
            double least = UNREACHABLE;
            for (const auto& of_one : alone) least = std::min(least, of_one[v]);
            CHECK((d[v] == UNREACHABLE) == (least == UNREACHABLE));
            if (d[v] == UNREACHABLE) {
                CHECK(solver->nearest(v) == NONE);
                continue;
            }
            const uint32_t nearest = solver->nearest(v);
            REQUIRE(nearest < sources.size());
            CHECK(alone[nearest][v] <= 1.25 * least);
        }
        for (uint32_t i = 0; i < sources.size(); ++i) CHECK(solver->nearest(sources[i]) == i);
    }
}

TEST_CASE("fast marching: targets, radius, other components, lengths of nothing") {
    const Mesh mesh = mesh_of(joined(bumpy_sphere(3, 2), sphere(2)));
    const uint32_t source = 5;
    const auto solver = marching_over(mesh);
    const auto all = field(mesh, *solver, {&source, 1});
    CHECK(std::ranges::count(all, UNREACHABLE) ==
          static_cast<std::ptrdiff_t>(mesh_of(sphere(2)).vertex_count()));

    const std::vector<uint32_t> targets{1, 40, 300};
    field(mesh, *solver, {&source, 1}, targets);
    for (const uint32_t t : targets) CHECK(solver->distance(t) == all[t]);
    const double radius =
        0.4 * *std::ranges::max_element(all, {}, [](double d) { return d < UNREACHABLE ? d : 0; });
    const auto within = field(mesh, *solver, {&source, 1}, {}, radius);
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v)
        if (all[v] <= radius) CHECK(within[v] == all[v]);

    auto lengths = edge_lengths(mesh);
    for (double& length : lengths) length *= 4;
    const auto fourfold = field(mesh, *FastMarchingMetric(mesh, lengths).make_solver(), {&source, 1});
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) CHECK(fourfold[v] == 4 * all[v]);

    for (size_t e = 0; e < lengths.size(); e += 3) lengths[e] = 0;
    const auto with_zeros = field(mesh, *FastMarchingMetric(mesh, lengths).make_solver(), {&source, 1});
    const auto along_edges = plain_dijkstra(mesh.vertex_count(), mesh.edges, lengths, {&source, 1});
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        CHECK((with_zeros[v] > 0) == (along_edges[v] > 0));
        CHECK((with_zeros[v] <= along_edges[v] * (1 + 1e-12)));
    }
}
