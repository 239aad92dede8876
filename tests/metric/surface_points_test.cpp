// Distances from and to points inside faces.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "src/metric/weighted_surface.h"
#include "src/metric/window_propagation.h"
#include "tests/support/meshes.h"
#include "tests/support/oracles.h"

using namespace geodesic;
using namespace geodesic::test;
using Eigen::Vector3d;

namespace {

Vector3d position_of(const Mesh& mesh, const SurfacePoint& point) {
    Vector3d p = Vector3d::Zero();
    for (size_t k = 0; k < 3; ++k) p += point.weights[k] * mesh.positions[mesh.faces[point.face][k]];
    return p;
}

// Inside of faces, on edges and at corners by turns.
std::vector<SurfacePoint> random_points(const Mesh& mesh, size_t count, uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<SurfacePoint> points;
    for (size_t i = 0; i < count; ++i) {
        std::array<double, 3> w{uniform(random, 0.01, 1), uniform(random, 0.01, 1), uniform(random, 0.01, 1)};
        if (i % 4 == 2) w[random() % 3] = 0;
        if (i % 4 == 3) {
            w = {};
            w[random() % 3] = 1;
        }
        const double sum = w[0] + w[1] + w[2];
        for (double& weight : w) weight /= sum;
        points.push_back({static_cast<uint32_t>(random() % mesh.face_count()), w});
    }
    return points;
}

// The mesh with a vertex at every point of a face's inside: splitting a face in three changes no distance.
struct Split {
    Mesh mesh;
    std::vector<uint32_t> vertex_of_point;
};

Split with_vertices_at(const Soup& soup, const std::vector<SurfacePoint>& points) {
    const Mesh mesh = mesh_of(soup);
    Soup split = soup;
    Split result;
    for (const SurfacePoint& point : points) {
        const auto [a, b, c] = soup.triangles[point.face];
        const uint32_t v = split.vertex_count();
        split.positions.push_back(position_of(mesh, point));
        result.vertex_of_point.push_back(v);
        split.triangles[point.face] = {a, b, v};
        split.triangles.push_back({b, c, v});
        split.triangles.push_back({c, a, v});
    }
    result.mesh = mesh_of(split);
    return result;
}

// One point inside of each of some faces.
std::vector<SurfacePoint> inner_points(const Mesh& mesh, size_t count, uint64_t seed) {
    std::vector<SurfacePoint> points;
    for (const SurfacePoint& point : random_points(mesh, 8 * count, seed)) {
        const bool inside = *std::ranges::min_element(point.weights) > 0;
        const bool taken = std::ranges::count(points, point.face, &SurfacePoint::face) > 0;
        if (inside && !taken && points.size() < count) points.push_back(point);
    }
    return points;
}

}

TEST_CASE("surface points: straight lines in a plane, between points, vertices and both") {
    const Mesh mesh = mesh_of(jittered_grid(7, 3));
    const auto solver = ExactMetric(mesh).make_solver();
    const auto points = random_points(mesh, 60, 1);
    for (size_t s = 0; s < 12; ++s) {
        const Vector3d from = position_of(mesh, points[s]);
        const uint32_t vertices[] = {0, 20, 63};
        solver->solve({{}, vertices, {&points[s], 1}, points});
        for (size_t t = 0; t < points.size(); ++t)
            CHECK(solver->point_distance(t) ==
                  doctest::Approx((position_of(mesh, points[t]) - from).norm()).epsilon(1e-11).scale(1e-3));
        for (uint32_t v : vertices)
            CHECK(solver->distance(v) == doctest::Approx((mesh.positions[v] - from).norm()).epsilon(1e-11));
        const uint32_t source = 33;
        solver->solve({{&source, 1}, {}, {}, points});
        for (size_t t = 0; t < points.size(); ++t)
            CHECK(solver->point_distance(t) ==
                  doctest::Approx((position_of(mesh, points[t]) - mesh.positions[source]).norm())
                      .epsilon(1e-11));
    }
}

TEST_CASE("surface points: as if there were vertices") {
    for (const Soup& soup :
         {bumpy_sphere(2, 4), cone(saddle_rays(10, 0.9), 4), comb(1), moebius(20, 3), l_shape(4)}) {
        const Mesh mesh = mesh_of(soup);
        const auto points = inner_points(mesh, 14, 5);
        const Split split = with_vertices_at(soup, points);
        const auto solver = ExactMetric(mesh).make_solver();
        const auto split_solver = ExactMetric(split.mesh).make_solver();
        for (size_t s = 0; s < points.size(); ++s) {
            solver->solve({{}, {}, {&points[s], 1}, {}});
            const auto expected = field(split.mesh, *split_solver, {&split.vertex_of_point[s], 1});
            double worst = 0;
            for (uint32_t v = 0; v < mesh.vertex_count(); ++v)
                worst = std::max(worst, std::abs(solver->distance(v) / expected[v] - 1));
            CHECK(worst < 1e-9);
            solver->solve({{}, {}, {&points[s], 1}, points});
            for (size_t t = 0; t < points.size(); ++t) {
                const double d = expected[split.vertex_of_point[t]];
                CHECK(std::abs(solver->point_distance(t) - d) <= 1e-9 * d);
            }
        }
    }
}

TEST_CASE("surface points: a corner given as a point is the vertex, the nearest of many sources counts") {
    const Mesh mesh = mesh_of(bumpy_sphere(2, 9));
    const auto solver = ExactMetric(mesh).make_solver();
    const SurfacePoint corner{10, {0, 1, 0}};
    const uint32_t vertex = mesh.faces[10][1];
    const auto expected = field(mesh, *solver, {&vertex, 1});
    solver->solve({{}, {}, {&corner, 1}, {}});
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v)
        CHECK(solver->distance(v) == doctest::Approx(expected[v]).epsilon(1e-11));

    const auto points = inner_points(mesh, 3, 2);
    std::vector<std::vector<double>> alone;
    for (const SurfacePoint& point : points) {
        solver->solve({{}, {}, {&point, 1}, {}});
        alone.emplace_back();
        for (uint32_t v = 0; v < mesh.vertex_count(); ++v) alone.back().push_back(solver->distance(v));
    }
    const uint32_t source = 4;
    alone.push_back(field(mesh, *solver, {&source, 1}));
    solver->solve({{&source, 1}, {}, points, {}});
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        double nearest = UNREACHABLE;
        for (const auto& d : alone) nearest = std::min(nearest, d[v]);
        CHECK(solver->distance(v) == doctest::Approx(nearest).epsilon(1e-11));
    }
}

TEST_CASE("surface points: hundreds of sources in one face") {
    const Mesh mesh = mesh_of(bumpy_sphere(2, 9));
    const auto solver = ExactMetric(mesh).make_solver();
    auto points = random_points(mesh, 400, 12);
    for (SurfacePoint& point : points) point.face = 17;
    std::vector<double> nearest(mesh.vertex_count(), UNREACHABLE);
    for (const SurfacePoint& point : points) {
        solver->solve({{}, {}, {&point, 1}, {}});
        for (uint32_t v = 0; v < mesh.vertex_count(); ++v)
            nearest[v] = std::min(nearest[v], solver->distance(v));
    }
    solver->solve({{}, {}, points, {}});
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v)
        CHECK(solver->distance(v) == doctest::Approx(nearest[v]).epsilon(1e-11));
}

TEST_CASE("surface points: stopping at a point leaves its distance as it is") {
    const Mesh mesh = mesh_of(torus(24, 12, 2, 0.7));
    const auto solver = ExactMetric(mesh).make_solver();
    const auto points = random_points(mesh, 20, 6);
    solver->solve({{}, {}, {&points[0], 1}, points});
    std::vector<double> all;
    for (size_t t = 0; t < points.size(); ++t) all.push_back(solver->point_distance(t));
    for (size_t t = 0; t < points.size(); ++t) {
        solver->solve({{}, {}, {&points[0], 1}, {&points[t], 1}});
        CHECK(solver->point_distance(0) == all[t]);
        solver->solve({{}, {}, {&points[t], 1}, {&points[0], 1}});
        CHECK(std::abs(solver->point_distance(0) - all[t]) <= 1e-10 * all[t]);
    }
}

TEST_CASE("surface points: on a weighted surface, as if there were vertices, within its steps") {
    const Soup soup = bumpy_sphere(2, 4);
    const Mesh mesh = mesh_of(soup);
    const std::vector<double> costs(mesh.face_count(), 3);
    const WeightedMetric metric(mesh, costs, 20);
    const auto solver = metric.make_solver();
    const auto exact = ExactMetric(mesh).make_solver();
    const auto points = inner_points(mesh, 10, 3);
    for (const SurfacePoint& point : points) {
        exact->solve({{}, {}, {&point, 1}, points});
        solver->solve({{}, {}, {&point, 1}, points});
        for (size_t t = 0; t < points.size(); ++t) {
            const double d = 3 * exact->point_distance(t);
            CHECK(solver->point_distance(t) >= d * (1 - 1e-12));
            CHECK(solver->point_distance(t) <= d * 1.01 + 1e-12);
        }
    }
}

TEST_CASE("surface points: next to a vertex, nearer than rounding can tell") {
    for (const Soup& soup : {grid(12, 12, 12, 12), jittered_grid(10, 4)}) {
        const Mesh mesh = mesh_of(soup);
        const auto solver = ExactMetric(mesh).make_solver();
        std::mt19937_64 random(3);
        for (double offset : {1e-30, 1e-17, 1e-16, 1e-15, 1e-14, 1e-13, 1e-10, 1e-6})
            for (int i = 0; i < 20; ++i) {
                SurfacePoint point{static_cast<uint32_t>(random() % mesh.face_count()), {}};
                const size_t corner = random() % 3;
                for (double& weight : point.weights) weight = offset * uniform(random, 0, 1);
                point.weights[corner] = 1 - point.weights[(corner + 1) % 3] - point.weights[(corner + 2) % 3];
                const Vector3d from = position_of(mesh, point);
                solver->solve({{}, {}, {&point, 1}, {}});
                double worst = 0;
                for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
                    const double d = (mesh.positions[v] - from).norm();
                    if (d > 0.01) worst = std::max(worst, std::abs(solver->distance(v) / d - 1));
                }
                CAPTURE(offset);
                CHECK(worst < 1e-9);
            }
    }
}

TEST_CASE("surface points: on an edge the cheaper face counts, whichever it is named in") {
    Soup soup;
    soup.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}};
    soup.triangles = {{0, 1, 2}, {1, 0, 3}};
    const Mesh mesh = mesh_of(soup);
    const double costs[] = {1000, 1};
    const auto solver = WeightedMetric(mesh, costs, 12).make_solver();
    const SurfacePoint in_dear{0, {0.5, 0.5, 0}}, in_cheap{1, {0.5, 0.5, 0}}, along{0, {0.49, 0.51, 0}},
        below{1, {0.35, 0.35, 0.3}}, corner{0, {1, 0, 0}};
    const SurfacePoint targets[] = {in_dear, in_cheap, along, below, corner};
    const double expected[] = {0, 0, 0.01, 0.3, 0.5};
    for (const SurfacePoint& source : {in_dear, in_cheap}) {
        solver->solve({{}, {}, {&source, 1}, targets});
        for (size_t t = 0; t < 5; ++t)
            CHECK(solver->point_distance(t) == doctest::Approx(expected[t]).epsilon(1e-9).scale(1e-3));
    }
    solver->solve({{}, {}, {&below, 1}, targets});
    for (size_t t = 0; t < 2; ++t) CHECK(solver->point_distance(t) == doctest::Approx(0.3));
    solver->solve({{}, {}, {&corner, 1}, targets});
    for (size_t t = 0; t < 2; ++t) CHECK(solver->point_distance(t) == doctest::Approx(0.5));
}
