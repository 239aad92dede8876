#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <doctest/doctest.h>

#include "src/mesh/components.h"
#include "src/metric/edge_graph.h"
#include "src/metric/window_propagation.h"
#include "src/partition/patch.h"
#include "src/partition/poisson_disk.h"
#include "src/partition/voronoi.h"
#include "tests/support/meshes.h"
#include "tests/support/oracles.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

std::vector<uint32_t> numbers_below(uint32_t count) {
    std::vector<uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0u);
    return numbers;
}

std::vector<std::vector<double>> fields(const Mesh& mesh, FieldSolver& solver,
                                        std::span<const uint32_t> sources) {
    std::vector<std::vector<double>> result;
    for (uint32_t s : sources) result.push_back(field(mesh, solver, {&s, 1}));
    return result;
}

// Faces within `reach` of a vertex, which hang together on the surfaces used here.
std::vector<uint32_t> faces_near(const Mesh& mesh, uint32_t vertex, double reach) {
    std::vector<uint32_t> faces;
    for (uint32_t f = 0; f < mesh.face_count(); ++f)
        if ((mesh.positions[mesh.faces[f][0]] - mesh.positions[vertex]).norm() < reach) faces.push_back(f);
    return faces;
}

}

TEST_CASE("Poisson-disk samples: as many as asked for, apart as far as they cover") {
    for (const Soup& soup : {bumpy_sphere(3, 1), torus(20, 10, 2, 0.7), grid(15, 15, 1, 1), annulus(24, 4)}) {
        const Mesh mesh = mesh_of(soup);
        const auto solver = ExactMetric(mesh).make_solver();
        const auto candidates = numbers_below(mesh.vertex_count());
        for (uint32_t count : {1u, 2u, 7u, 40u}) {
            Random random(count);
            const auto samples =
                poisson_disk_samples(*solver, components_of(mesh).of_vertex, candidates, count, random);
            REQUIRE(samples.size() == count);
            CHECK(std::set(samples.begin(), samples.end()).size() == count);
            if (count == 1) continue;
            const auto distance = fields(mesh, *solver, samples);
            double closest = UNREACHABLE, covering = 0;
            for (size_t i = 0; i < count; ++i)
                for (size_t j = 0; j < i; ++j) closest = std::min(closest, distance[i][samples[j]]);
            for (uint32_t v : candidates) {
                double nearest = UNREACHABLE;
                for (const auto& d : distance) nearest = std::min(nearest, d[v]);
                covering = std::max(covering, nearest);
            }
            // The radius shrinks by a fifth at a time, so "up to the last step of its search" is that much.
            CHECK(covering <= closest / 0.8 * (1 + 1e-9));
        }
    }
}

TEST_CASE("Poisson-disk samples: of the candidates only; all of them where they are too few") {
    const Mesh mesh = mesh_of(bumpy_sphere(3, 2));
    const auto solver = ExactMetric(mesh).make_solver();
    std::vector<uint32_t> candidates;
    for (uint32_t v = 3; v < mesh.vertex_count(); v += 9) candidates.push_back(v);
    const auto total = static_cast<uint32_t>(candidates.size());
    for (uint32_t count : {1u, 5u, total - 1, total, total + 1, 10 * total}) {
        Random random(4);
        auto samples =
            poisson_disk_samples(*solver, components_of(mesh).of_vertex, candidates, count, random);
        std::sort(samples.begin(), samples.end());
        CHECK(samples.size() == std::min(count, total));
        CHECK(std::adjacent_find(samples.begin(), samples.end()) == samples.end());
        CHECK(std::includes(candidates.begin(), candidates.end(), samples.begin(), samples.end()));
    }
}

TEST_CASE("Poisson-disk samples: every component gets some, the seed decides which") {
    const Soup part = sphere(2);
    const Mesh mesh = mesh_of(joined(joined(part, part), part));
    const auto solver = ExactMetric(mesh).make_solver();
    const auto candidates = numbers_below(mesh.vertex_count());
    std::set<std::vector<uint32_t>> seen;
    for (uint64_t seed = 1; seed <= 5; ++seed) {
        Random random(seed), again(seed);
        const auto samples =
            poisson_disk_samples(*solver, components_of(mesh).of_vertex, candidates, 24, random);
        CHECK(samples == poisson_disk_samples(*solver, components_of(mesh).of_vertex, candidates, 24, again));
        seen.insert(samples);
        std::set<uint32_t> components;
        for (uint32_t v : samples) components.insert(v / part.vertex_count());
        CHECK(components.size() == 3);
        CHECK(samples.size() == 24);
    }
    CHECK(seen.size() == 5);
}

// Whatever comes first in the random order: loose triangles are smaller than any disk on the body.
TEST_CASE("Poisson-disk samples: loose triangles beside a body get none, and the body's are apart") {
    const Soup body = sphere(3);
    Soup soup = body;
    for (uint32_t i = 0; i < 500; ++i) {
        const auto first = soup.vertex_count();
        for (const double x : {0.0, 1e-3, 0.0})
            soup.positions.push_back({3 + x, 1e-3 * (soup.vertex_count() % 3), 1.0 * i});
        soup.triangles.push_back({first, first + 1, first + 2});
    }
    const Mesh mesh = mesh_of(soup);
    const auto solver = ExactMetric(mesh).make_solver();
    const auto candidates = numbers_below(mesh.vertex_count());
    const auto is_on_body = [&](uint32_t v) { return mesh.positions[v].norm() < 2; };
    for (uint64_t seed = 1; seed <= 5; ++seed) {
        Random random(seed);
        const auto samples =
            poisson_disk_samples(*solver, components_of(mesh).of_vertex, candidates, 12, random);
        REQUIRE(samples.size() == 12);
        CHECK(std::ranges::all_of(samples, is_on_body));
        for (size_t i = 0; i < samples.size(); ++i)
            for (size_t j = 0; j < i; ++j)
                CHECK((mesh.positions[samples[i]] - mesh.positions[samples[j]]).norm() > 0.5);
    }
}

TEST_CASE("Poisson-disk samples: vertices at distance zero of each other are one sample, and it ends") {
    const Mesh mesh = mesh_of(grid(6, 6, 1, 1));
    std::vector<double> cost(mesh.edges.size(), 0.0);
    const auto candidates = numbers_below(mesh.vertex_count());
    Random random(1);
    CHECK(poisson_disk_samples(*EdgeGraphMetric(mesh, cost).make_solver(), components_of(mesh).of_vertex,
                               candidates, 10, random)
              .size() == 1);
}

TEST_CASE("Voronoi cells: each face in the cell of most of its vertices, or of the nearest one") {
    for (const Soup& soup :
         {bumpy_sphere(3, 3), jittered_grid(15, 1), joined(sphere(2), torus(9, 7, 2, 0.5))}) {
        const Mesh mesh = mesh_of(soup);
        const auto solver = ExactMetric(mesh).make_solver();
        std::mt19937_64 random(5);
        for (const auto& faces : {numbers_below(mesh.face_count()), faces_near(mesh, 0, 0.7)})
            for (size_t count : {1u, 2u, 9u}) {
                std::vector<uint32_t> seeds(count);
                for (uint32_t& s : seeds) s = mesh.faces[faces[random() % faces.size()]][0];
                const auto distance = fields(mesh, *solver, seeds);
                const auto cell = voronoi_cells(*solver, mesh, faces, seeds);
                REQUIRE(cell.size() == faces.size());
                size_t wrong = 0, tested = 0;
                for (size_t i = 0; i < faces.size(); ++i) {
                    // Per corner: its nearest seed, and whether another one is just as near.
                    std::array<uint32_t, 3> owner{};
                    std::array<double, 3> nearest{};
                    bool tie = false;
                    for (size_t k = 0; k < 3; ++k) {
                        nearest[k] = UNREACHABLE;
                        owner[k] = NONE;
                        for (uint32_t s = 0; s < count; ++s) {
                            const double d = distance[s][mesh.faces[faces[i]][k]];
                            if (d < UNREACHABLE) tie = tie || std::abs(d - nearest[k]) < 1e-9;
                            if (!(d < nearest[k])) continue;
                            nearest[k] = d;
                            owner[k] = s;
                        }
                    }
                    if (tie) continue; // either is right
                    ++tested;
                    uint32_t expected = owner[static_cast<size_t>(
                        std::min_element(nearest.begin(), nearest.end()) - nearest.begin())];
                    if (owner[0] == owner[1] || owner[0] == owner[2])
                        expected = owner[0];
                    else if (owner[1] == owner[2])
                        expected = owner[1];
                    wrong += cell[i] != expected;
                }
                CHECK(wrong == 0);
                CHECK(tested > faces.size() / 4);
            }
    }
}

TEST_CASE("Lloyd: a seed moves to the vertex of its cell farthest from the cell's border") {
    for (const Soup& soup : {bumpy_sphere(3, 4), jittered_grid(16, 2), annulus(24, 5)}) {
        const Mesh mesh = mesh_of(soup);
        const auto solver = ExactMetric(mesh).make_solver();
        for (const auto& faces : {numbers_below(mesh.face_count()), faces_near(mesh, 0, 0.9)}) {
            const auto vertices = vertices_of(mesh, faces);
            Random random(3);
            const auto before =
                poisson_disk_samples(*solver, components_of(mesh).of_vertex, vertices, 6, random);
            const auto cell = voronoi_cells(*solver, mesh, faces, before);
            auto after = before;
            relax_seeds(*solver, mesh, faces, cell, after);

            // A vertex is inside a cell if all faces of the mesh around it are in the patch and in the cell.
            std::vector<uint32_t> cell_of_face(mesh.face_count(), NONE), border;
            for (size_t i = 0; i < faces.size(); ++i) cell_of_face[faces[i]] = cell[i];
            std::vector<uint32_t> inside(mesh.vertex_count(), NONE);
            for (uint32_t v : vertices) {
                const auto around = mesh.vertex_faces[v];
                inside[v] = cell_of_face[around[0]];
                for (uint32_t f : around)
                    if (cell_of_face[f] != inside[v]) inside[v] = NONE;
                if (inside[v] == NONE) border.push_back(v);
            }
            REQUIRE(!border.empty());
            const auto to_border = field(mesh, *solver, border);
            for (uint32_t s = 0; s < before.size(); ++s) {
                double farthest = 0;
                for (uint32_t v : vertices)
                    if (inside[v] == s) farthest = std::max(farthest, to_border[v]);
                if (farthest == 0) {
                    CHECK(after[s] == before[s]); // no vertex inside: it stays
                    continue;
                }
                CHECK(inside[after[s]] == s);
                CHECK(to_border[after[s]] == doctest::Approx(farthest).epsilon(1e-9));
            }
        }
    }
}

TEST_CASE("Lloyd: one cell over a closed surface has no border, its seed stays") {
    const Mesh mesh = mesh_of(sphere(2));
    const auto solver = ExactMetric(mesh).make_solver();
    const auto faces = numbers_below(mesh.face_count());
    std::vector<uint32_t> seeds{17};
    relax_seeds(*solver, mesh, faces, std::vector<uint32_t>(faces.size(), 0), seeds);
    CHECK(seeds == std::vector<uint32_t>{17});
}
