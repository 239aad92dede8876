// What a solve for a few targets leaves out, and that it leaves out no more. That target vertices keep every
// bit is in exact_property_test.cpp, on many surfaces, and for points in surface_points_test.cpp.
#include <array>
#include <vector>

#include <doctest/doctest.h>

#include "src/metric/window_propagation.h"
#include "tests/support/meshes.h"
#include "tests/support/oracles.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// A flat square of SIDE x SIDE cells, and vertices of it by column and row.
constexpr uint32_t SIDE = 40;

uint32_t at(uint32_t column, uint32_t row) { return row * (SIDE + 1) + column; }

double distance_to(FieldSolver& solver, uint32_t source, uint32_t target, uint32_t final_count = 0) {
    FieldRequest request{{&source, 1}, {&target, 1}, {}, {}};
    request.final_count = final_count;
    solver.solve(request);
    return solver.distance(target);
}

}

TEST_CASE("target bounds: what lies behind the source is left out") {
    const Mesh mesh = mesh_of(grid(SIDE, SIDE, SIDE, SIDE));
    const auto solver = ExactMetric(mesh).make_solver();
    // The disc around the source as far as the target is all of the square.
    CHECK(distance_to(*solver, at(20, 20), at(38, 20)) == doctest::Approx(18));
    size_t behind = 0;
    for (const uint32_t vertex : solver->reached()) behind += mesh.positions[vertex].x() < 15;
    CHECK(behind == 0);
    CHECK(solver->reached().size() < mesh.vertex_count() / 4);
    CHECK(distance_to(*solver, at(20, 20), at(20, 20)) == 0);
}

TEST_CASE("target bounds: what is asked for besides the targets is final") {
    const Mesh mesh = mesh_of(bumpy_sphere(4, 3));
    const auto solver = ExactMetric(mesh).make_solver();
    const uint32_t source = 17, target = 1200;
    const auto full = field(mesh, *solver, {&source, 1});
    for (const uint32_t count : {1u, 60u, 300u}) {
        CHECK(distance_to(*solver, source, target, count) == full[target]);
        const double final_up_to = solver->final_up_to();
        size_t final_vertices = 0;
        for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
            if (full[v] > final_up_to) continue;
            ++final_vertices;
            CHECK(solver->distance(v) == full[v]);
        }
        CHECK(final_vertices >= count);
        // Some of the vertices that are nearer than the target are left out.
        size_t nearer = 0, reached = 0;
        for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
            nearer += full[v] < full[target];
            reached += full[v] < full[target] && solver->distance(v) < UNREACHABLE;
        }
        CHECK(reached < nearer);
    }
}

TEST_CASE("target bounds: points as near to a source as nothing, and beside others") {
    const Mesh flat = mesh_of(jittered_grid(8, 3));
    Mesh far = flat;
    for (auto& position : far.positions) position += Eigen::Vector3d(1e5, -3e5, 2e5);
    for (const Mesh* const mesh : std::array{&flat, static_cast<const Mesh*>(&far)}) {
        const auto solver = ExactMetric(*mesh).make_solver();
        for (const uint32_t face : {3u, 40u, 100u}) {
            const uint32_t vertex = mesh->faces[face][0], other = mesh->faces[127 - face][1];
            const std::vector<SurfacePoint> targets{
                {face, {1, 0, 0}}, {face, {1 - 2e-12, 1e-12, 1e-12}}, {127 - face, {0.2, 0.3, 0.5}}};
            const std::array<uint32_t, 2> sources{vertex, other};
            for (const size_t count : {size_t{1}, size_t{2}}) {
                const std::span<const uint32_t> from(sources.data(), count);
                solver->solve({from, {}, {}, targets});
                CHECK(solver->point_distance(0) == 0);
                CHECK(solver->point_distance(1) <= 1e-11);
                const double together = solver->point_distance(2);
                solver->solve({from, {}, {}, {&targets[2], 1}});
                CHECK(solver->point_distance(0) == together);
                CHECK(together > 0);
                if (count == 2) CHECK(together < 1); // `other` is a corner of its face
            }
        }
    }
}

TEST_CASE("target bounds: lengths that are given may be shorter than lines in space") {
    const Mesh mesh = mesh_of(jittered_grid(12, 5));
    std::vector<double> lengths;
    for (uint32_t e = 0; e < mesh.edge_count(); ++e) lengths.push_back(mesh.edge_length(e) / 100);
    const auto given = ExactMetric(mesh, 0, lengths).make_solver(), own = ExactMetric(mesh).make_solver();
    for (const uint32_t target : {5u, 77u, 168u})
        CHECK(distance_to(*given, 0, target) ==
              doctest::Approx(distance_to(*own, 0, target) / 100).epsilon(1e-10));
}

TEST_CASE("target bounds: a target that cannot be reached is at infinity") {
    const Mesh mesh = mesh_of(joined(sphere(2), jittered_grid(8, 3)));
    const auto solver = ExactMetric(mesh).make_solver();
    CHECK(distance_to(*solver, 0, mesh.vertex_count() - 1) == UNREACHABLE);
    CHECK(distance_to(*solver, 0, 1) < UNREACHABLE);
}
