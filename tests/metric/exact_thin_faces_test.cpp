// Slivers and faces without area: where a path's direction is nearly lost, its length must not be.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "src/metric/window_propagation.h"
#include "tests/support/meshes.h"
#include "tests/support/oracles.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;
using Eigen::Vector3d;

namespace {

// Triangles between lattice points, glued to each other at random along edges, at most `faces` at one: many
// of them lie in one line. Every coordinate is then moved by up to `jitter`.
Soup lattice_soup(std::mt19937_64& random, size_t faces, double jitter) {
    std::set<std::array<int, 3>> places;
    const auto count = 6 + random() % 25;
    while (places.size() < count)
        places.insert(
            {static_cast<int>(random() % 4), static_cast<int>(random() % 4), static_cast<int>(random() % 3)});
    std::vector<Vector3d> positions;
    for (const auto& [x, y, z] : places)
        positions.push_back(
            {x + uniform(random, 0, jitter), y + uniform(random, 0, jitter), z + uniform(random, 0, jitter)});
    std::ranges::shuffle(positions, random);

    std::map<std::pair<uint32_t, uint32_t>, size_t> faces_at;
    std::vector<std::array<uint32_t, 3>> triangles{{0, 1, 2}};
    const auto edge = [](uint32_t a, uint32_t b) { return std::minmax({a, b}); };
    for (size_t k = 0; k < 3; ++k) ++faces_at[edge(triangles[0][k], triangles[0][(k + 1) % 3])];
    for (int i = 0; i < 100; ++i) {
        const auto& t = triangles[random() % triangles.size()];
        const size_t k = random() % 3;
        const uint32_t a = t[k], b = t[(k + 1) % 3], c = static_cast<uint32_t>(random() % positions.size());
        if (c == a || c == b) continue;
        if (std::max({faces_at[edge(a, b)], faces_at[edge(b, c)], faces_at[edge(a, c)]}) >= faces) continue;
        const bool twice = std::ranges::any_of(triangles, [&](const auto& other) {
            return std::set(other.begin(), other.end()) == std::set{a, b, c};
        });
        if (twice) continue;
        for (const auto& [p, q] : {edge(a, b), edge(b, c), edge(a, c)}) ++faces_at[{p, q}];
        triangles.push_back({a, b, c});
    }
    // Only what is used, numbered anew.
    Soup soup;
    std::map<uint32_t, uint32_t> number;
    for (auto& triangle : triangles)
        for (uint32_t& v : triangle) {
            const auto [entry, added] = number.try_emplace(v, soup.vertex_count());
            if (added) soup.positions.push_back(positions[v]);
            v = entry->second;
        }
    soup.triangles = triangles;
    return soup;
}

double largest_asymmetry(const Mesh& mesh) {
    std::vector<std::vector<double>> d;
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) d.push_back(exact_field(mesh, v));
    double largest = 0;
    for (uint32_t a = 0; a < mesh.vertex_count(); ++a)
        for (uint32_t b = 0; b < a; ++b)
            if (d[a][b] != d[b][a]) largest = std::max(largest, std::abs(d[a][b] / d[b][a] - 1));
    return largest;
}

}

TEST_CASE("thin faces: there and back are equally long, in slivers and through faces without area" *
          doctest::skip(SANITIZED)) {
    std::mt19937_64 random(11);
    for (double jitter : {0.0, 1e-7, 1e-5, 1e-4})
        for (size_t faces : {2u, 4u})
            for (int i = 0; i < 150; ++i) {
                const Soup soup = lattice_soup(random, faces, jitter);
                CAPTURE(jitter);
                CAPTURE(i);
                CHECK(largest_asymmetry(mesh_of(soup)) < 1e-6);
            }
}

TEST_CASE("thin faces: never above Steiner points, never far below") {
    std::mt19937_64 random(12);
    for (double jitter : {0.0, 1e-5, 1e-4})
        for (int i = 0; i < 25; ++i) {
            const Mesh mesh = mesh_of(lattice_soup(random, 2, jitter));
            CAPTURE(jitter);
            CAPTURE(i);
            const auto exact = exact_field(mesh, 0), bound = steiner_distances(mesh, 0, 40);
            for (uint32_t v = 1; v < mesh.vertex_count(); ++v) {
                CHECK(exact[v] <= bound[v] * (1 + 1e-6));
                CHECK(exact[v] >= bound[v] * 0.97);
            }
        }
}

TEST_CASE("thin faces: a path across a face without area") {
    // Vertex 2 lies in the middle of the edge 0-1 of the upper face, which a flat face joins to the lower
    // one.
    Soup soup;
    soup.positions = {{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1.9, -0.5, 0}};
    soup.triangles = {{0, 1, 3}, {0, 2, 1}, {0, 2, 4}};
    const Mesh mesh = mesh_of(soup);
    // The two faces share the way from vertex 0 to vertex 2 only: straight from 3 to 2, or beside it.
    const double straight = std::hypot(0.9, 1.5), crossing = 1 + 0.9 / 1.5;
    REQUIRE(crossing > 1); // the straight line misses the shared way
    const double expected = 1 + std::hypot(0.9, 0.5);
    CHECK(expected > straight);
    CHECK(exact_field(mesh, 4)[3] == doctest::Approx(expected).epsilon(1e-6));
    CHECK(exact_field(mesh, 3)[4] == doctest::Approx(expected).epsilon(1e-6));
}

// What gives a face without area a height changes lengths by 2e-15 of the longest edge of that face, which is
// far more than rounding for a small part beside it.
TEST_CASE("faces without area: other components have the distances that they have alone") {
    const Soup small = jittered_grid(8, 3);
    Soup flat;
    flat.positions = {{0, 0, 9}, {1e9, 0, 9}, {5e8, 0, 9}};
    flat.triangles = {{0, 1, 2}};
    const Mesh alone = mesh_of(small), beside = mesh_of(joined(small, flat));
    const auto solver = ExactMetric(alone).make_solver(), solver_beside = ExactMetric(beside).make_solver();
    const uint32_t source = 0;
    const auto field_alone = field(alone, *solver, {&source, 1}),
               field_beside = field(beside, *solver_beside, {&source, 1});
    for (uint32_t v = 0; v < alone.vertex_count(); ++v)
        CHECK(field_beside[v] == doctest::Approx(field_alone[v]).epsilon(1e-12));
    CHECK(field_beside.back() == UNREACHABLE);
}
