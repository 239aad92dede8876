// Distances where faces cost differently, against Snell's law, Steiner points made apart from the library,
// and the exact metric.
#include "src/metric/weighted_surface.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <doctest/doctest.h>

#include "src/metric/edge_graph.h"
#include "src/metric/window_propagation.h"
#include "tests/support/meshes.h"
#include "tests/support/oracles.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;
using Eigen::Vector3d;

namespace {

std::vector<double> equal_costs(const Mesh& mesh, double cost) {
    return std::vector<double>(mesh.face_count(), cost);
}

std::vector<double> random_costs(const Mesh& mesh, uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<double> costs(mesh.face_count());
    for (double& cost : costs) cost = uniform(random, 0.5, 4);
    return costs;
}

double smallest_on(double begin, double end, const std::function<double(double)>& convex) {
    for (int i = 0; i < 100; ++i) {
        const double third = (end - begin) / 3;
        if (convex(begin + third) < convex(end - third))
            end -= third;
        else
            begin += third;
    }
    return convex(0.5 * (begin + end));
}

// The unit square, x < 1/2 at cost 1, the rest at cost `right`: straight to one point of the line between, or
// along it.
double refracted(const Vector3d& a, const Vector3d& b, double right) {
    const auto side = [](const Vector3d& p) { return p.x() < 0.5 ? 0 : p.x() > 0.5 ? 1 : 2; };
    const auto cost = [&](const Vector3d& p) { return side(p) == 1 ? right : 1.0; };
    const auto to_line = [&](const Vector3d& p, double y) {
        return (side(p) == 2 ? 1 : cost(p)) * std::hypot(p.x() - 0.5, p.y() - y);
    };
    // In at y1, along the line at the cheaper cost, out at y2: convex in both.
    const double bent = smallest_on(0, 1, [&](double y1) {
        return smallest_on(0, 1,
                           [&](double y2) { return to_line(a, y1) + std::abs(y1 - y2) + to_line(b, y2); });
    });
    if (side(a) == 2 || side(b) == 2 || side(a) != side(b)) return bent;
    return std::min(bent, cost(a) * (a - b).norm());
}

}

TEST_CASE("weighted: refraction across a line between two costs is within 0.5 % of Snell's law" *
          doctest::skip(SANITIZED)) {
    const Mesh mesh = mesh_of(grid(16, 16, 1, 1));
    for (double right : {1.0, 1.5, 3.0, 20.0}) {
        CAPTURE(right);
        std::vector<double> costs;
        for (const auto& face : mesh.faces) {
            double x = 0;
            for (uint32_t v : face) x += mesh.positions[v].x() / 3;
            costs.push_back(x < 0.5 ? 1 : right);
        }
        const auto solver = WeightedMetric(mesh, costs, 12).make_solver();
        double above = 0, below = 0;
        for (uint32_t source : {0u, 5u, 150u, 284u}) {
            const auto found = field(mesh, *solver, {&source, 1});
            for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
                if (v == source) continue;
                const double expected = refracted(mesh.positions[source], mesh.positions[v], right);
                above = std::max(above, found[v] / expected - 1);
                below = std::max(below, 1 - found[v] / expected);
            }
        }
        CHECK(above < 0.005);
        CHECK(below < 1e-9);
    }
}

TEST_CASE("weighted: equal costs are the same Steiner graph, scaled") {
    for (const Soup& soup :
         {bumpy_sphere(2, 3), torus(14, 8, 2, 0.7), moebius(20, 3), comb(1), pinched_sheets(3)}) {
        const Mesh mesh = mesh_of(soup);
        for (uint32_t points : {0u, 1u, 5u})
            for (uint32_t source : {0u, mesh.vertex_count() / 2}) {
                const auto expected = steiner_distances(mesh, source, points);
                const auto solver = WeightedMetric(mesh, equal_costs(mesh, 2.5), points).make_solver();
                auto found = field(mesh, *solver, {&source, 1});
                for (double& d : found) d /= 2.5;
                CHECK(largest_relative_difference(found, expected) < 1e-12);
            }
    }
}

TEST_CASE("weighted: equal costs are within the stated bound of the exact metric") {
    // On a flat grid the true path is the straight line; the faces that it crosses are counted apart.
    constexpr uint32_t CELLS = 12, POINTS = 4;
    const Mesh mesh = mesh_of(grid(CELLS, CELLS, 1, 1));
    const double longest = std::sqrt(2.0) / CELLS;
    const auto solver = WeightedMetric(mesh, equal_costs(mesh, 1), POINTS).make_solver();
    for (uint32_t source : {0u, 31u, 90u}) {
        const auto found = field(mesh, *solver, {&source, 1});
        for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
            const Vector3d between = mesh.positions[v] - mesh.positions[source];
            // A line meets each of the three families of grid lines once per cell that it advances.
            const double crossings =
                CELLS * (std::abs(between.x()) + std::abs(between.y()) + std::abs(between.x() - between.y()));
            const double bound = (crossings + 1) * longest / (POINTS + 1);
            CHECK(found[v] >= between.norm() * (1 - 1e-12));
            CHECK(found[v] <= between.norm() + bound);
        }
    }
}

TEST_CASE("weighted: more points bring it down to what it converges to, and never below") {
    const Mesh mesh = mesh_of(bumpy_sphere(2, 5));
    const auto costs = random_costs(mesh, 4);
    const uint32_t source = 3;
    const auto at = [&](uint32_t points) {
        return field(mesh, *WeightedMetric(mesh, costs, points).make_solver(), {&source, 1});
    };
    const auto coarse = at(3), fine = at(7),
               finer = at(31); // 4, 8, 32 spacings: each set of points holds the one before
    double from_coarse = 0, from_fine = 0;
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        CHECK(fine[v] <= coarse[v] * (1 + 1e-12));
        CHECK(finer[v] <= fine[v] * (1 + 1e-12));
        if (v == source) continue;
        from_coarse += coarse[v] / finer[v] - 1;
        from_fine += fine[v] / finer[v] - 1;
    }
    CHECK(from_fine < 0.6 * from_coarse);
}

TEST_CASE("weighted: symmetric, stops early without a change, and is used again without a trace") {
    const Mesh mesh = mesh_of(joined(bumpy_sphere(2, 6), grid(4, 4, 1, 1)));
    const WeightedMetric metric(mesh, random_costs(mesh, 8), 4);
    const auto solver = metric.make_solver();
    const uint32_t a = 7, b = 40;
    const auto from_a = field(mesh, *solver, {&a, 1}), from_b = field(mesh, *solver, {&b, 1});
    CHECK(from_a[b] == doctest::Approx(from_b[a]).epsilon(1e-12));
    CHECK(from_a[mesh.vertex_count() - 1] == UNREACHABLE);
    CHECK(field(mesh, *solver, {&a, 1}, {&b, 1})[b] == from_a[b]);
    const auto within = field(mesh, *solver, {&a, 1}, {}, 0.5 * from_a[b]);
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v)
        if (from_a[v] <= 0.5 * from_a[b]) CHECK(within[v] == from_a[v]);
    CHECK(field(mesh, *solver, {&a, 1}) == from_a);
    const uint32_t both[] = {a, b};
    solver->solve(both, {});
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        CHECK(solver->distance(v) == std::min(from_a[v], from_b[v]));
        if (from_a[v] != from_b[v]) CHECK(solver->nearest(v) == (from_a[v] < from_b[v] ? 0 : 1));
    }
}

TEST_CASE("weighted surface: the nearest vertices, as many as are asked for besides targets, are final") {
    const Mesh mesh = mesh_of(bumpy_sphere(3, 3));
    std::mt19937_64 random(5);
    std::vector<double> costs(mesh.face_count());
    for (double& cost : costs) cost = uniform(random, 1, 5);
    const auto solver = WeightedMetric(mesh, costs, 3).make_solver();
    const uint32_t source = 17, target = 20;
    const auto full = field(mesh, *solver, {&source, 1});
    for (const uint32_t count : {1u, 60u, 300u, 5000u}) {
        FieldRequest request{{&source, 1}, {&target, 1}, {}, {}};
        request.final_count = count;
        solver->solve(request);
        CHECK(solver->distance(target) == full[target]);
        size_t final_vertices = 0;
        for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
            if (full[v] > solver->final_up_to()) continue;
            ++final_vertices;
            CHECK(solver->distance(v) == full[v]);
        }
        CHECK(final_vertices >= std::min(count, mesh.vertex_count()));
        CHECK((solver->reached().size() < mesh.vertex_count()) == (count <= 300));
    }
    solver->solve({&source, 1}, {}, 0.5);
    CHECK(solver->final_up_to() >= 0.5);
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v)
        if (full[v] <= 0.5) CHECK(solver->distance(v) == full[v]);
}
