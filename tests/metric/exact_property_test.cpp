// What must hold of exact distances on any surface.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "src/mesh/intake.h"
#include "src/metric/edge_graph.h"
#include "src/metric/window_propagation.h"
#include "tests/support/meshes.h"
#include "tests/support/oracles.h"

using namespace geodesic;
using namespace geodesic::test;
using Eigen::Vector3d;

namespace {

struct Surface {
    std::string name;
    Soup soup;
};

std::vector<Surface> surfaces() {
    return {{"bumpy sphere", bumpy_sphere(3, 1)},
            {"torus", torus(24, 12, 2, 0.7)},
            {"regular grid", grid(15, 15, 1, 1)},
            {"saddle", cone(saddle_rays(12, 0.8), 8)},
            {"cube", cube(5)},
            {"annulus", annulus(20, 4)},
            {"Moebius strip", moebius(30, 4)},
            {"mixed winding", with_mixed_winding(bumpy_sphere(3, 2), 5)},
            {"pinched sheets", pinched_sheets(4)},
            {"edges of three faces", comb(2)},
            {"two components", joined(sphere(2), jittered_grid(8, 3))}};
}

std::vector<uint32_t> random_vertices(const Mesh& mesh, size_t count, uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<uint32_t> vertices(count);
    for (uint32_t& v : vertices) v = static_cast<uint32_t>(random() % mesh.vertex_count());
    return vertices;
}

}

TEST_CASE("exact: symmetric, between the straight line and the edge graph") {
    for (const auto& [name, soup] : surfaces()) {
        const auto& surface_name = name; // clang 14 captures no structured binding
        CAPTURE(surface_name);
        const Mesh mesh = mesh_of(soup);
        const auto solver = ExactMetric(mesh).make_solver();
        const auto lengths = edge_lengths(mesh);
        const auto vertices = random_vertices(mesh, 12, 7);
        std::vector<std::vector<double>> fields;
        for (uint32_t s : vertices) {
            fields.push_back(field(mesh, *solver, {&s, 1}));
            const auto along_edges = plain_dijkstra(mesh.vertex_count(), mesh.edges, lengths, {&s, 1});
            size_t above = 0, below = 0, lost = 0;
            for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
                const double d = fields.back()[v];
                above += d > along_edges[v] * (1 + 1e-12);
                below += d < (mesh.positions[s] - mesh.positions[v]).norm() * (1 - 1e-12);
                lost += (d == UNREACHABLE) != (along_edges[v] == UNREACHABLE) || std::isnan(d);
            }
            CHECK(above == 0);
            CHECK(below == 0);
            CHECK(lost == 0);
            CHECK(fields.back()[s] == 0);
        }
        for (size_t i = 0; i < vertices.size(); ++i)
            for (size_t j = 0; j < i; ++j) {
                const double there = fields[i][vertices[j]], back = fields[j][vertices[i]];
                CHECK((there == back || std::abs(there - back) <= 1e-10 * back));
            }
    }
}

TEST_CASE("exact: the triangle inequality, and no vertex farther than its neighbour and their edge") {
    for (const auto& [name, soup] : surfaces()) {
        const auto& surface_name = name; // clang 14 captures no structured binding
        CAPTURE(surface_name);
        const Mesh mesh = mesh_of(soup);
        const auto lengths = edge_lengths(mesh);
        for (uint32_t s : random_vertices(mesh, 3, 8)) {
            const auto d = exact_field(mesh, s);
            size_t violated = 0;
            for (uint32_t e = 0; e < mesh.edge_count(); ++e) {
                const auto [a, b] = mesh.edges[e];
                if (d[a] == UNREACHABLE) continue;
                violated += std::abs(d[a] - d[b]) > lengths[e] * (1 + 1e-9) + 1e-12;
            }
            CHECK(violated == 0);
        }
    }
}

TEST_CASE("exact: a solver used again gives what a fresh one gives, bit for bit") {
    for (const auto& [name, soup] : surfaces()) {
        const auto& surface_name = name; // clang 14 captures no structured binding
        CAPTURE(surface_name);
        const Mesh mesh = mesh_of(soup);
        const ExactMetric metric(mesh);
        const auto used = metric.make_solver();
        std::mt19937_64 random(3);
        for (uint32_t s : random_vertices(mesh, 6, 9)) {
            CHECK(field(mesh, *used, {&s, 1}) == field(mesh, *metric.make_solver(), {&s, 1}));
            // A solve that stops early must leave nothing behind.
            const uint32_t target = static_cast<uint32_t>(random() % mesh.vertex_count());
            used->solve({&s, 1}, {&target, 1});
            used->solve({&target, 1}, {}, uniform(random, 0, 0.5));
        }
    }
}

// Windows that are of no use to the targets may be joined to others in a full solve.
TEST_CASE("exact: stopping at a radius changes no final distance, stopping at targets by rounding only") {
    constexpr double ROUNDING = 1e-14;
    for (const auto& [name, soup] : surfaces()) {
        const auto& surface_name = name; // clang 14 captures no structured binding
        CAPTURE(surface_name);
        const Mesh mesh = mesh_of(soup);
        const auto solver = ExactMetric(mesh).make_solver();
        for (uint32_t s : random_vertices(mesh, 4, 10)) {
            const auto full = field(mesh, *solver, {&s, 1});
            for (size_t count : {1u, 3u, 40u}) {
                auto targets = random_vertices(mesh, count, s + count);
                targets.push_back(targets.front()); // given twice
                const auto stopped = field(mesh, *solver, {&s, 1}, targets);
                for (uint32_t t : targets) {
                    if (full[t] == UNREACHABLE)
                        CHECK(stopped[t] == UNREACHABLE);
                    else
                        CHECK(std::abs(stopped[t] - full[t]) <= ROUNDING * full[t]);
                }
                for (uint32_t v = 0; v < mesh.vertex_count(); ++v)
                    REQUIRE(stopped[v] >= full[v] * (1 - ROUNDING));
            }
            const uint32_t self = s;
            CHECK(field(mesh, *solver, {&s, 1}, {&self, 1})[s] == 0);
            for (double radius : {0.0, 0.3, 0.9, full[(s * 7 + 5) % mesh.vertex_count()]}) {
                const auto within = field(mesh, *solver, {&s, 1}, {}, radius);
                size_t wrong = 0;
                for (uint32_t v = 0; v < mesh.vertex_count(); ++v)
                    wrong += full[v] <= radius ? within[v] != full[v] : within[v] < full[v];
                CHECK(wrong == 0);
            }
        }
    }
}

TEST_CASE("exact: from many sources, the nearest one by distance and by name") {
    for (const auto& [name, soup] : surfaces()) {
        const auto& surface_name = name; // clang 14 captures no structured binding
        CAPTURE(surface_name);
        const Mesh mesh = mesh_of(soup);
        const ExactMetric metric(mesh);
        const auto solver = metric.make_solver();
        for (size_t count : {2u, 5u, 30u}) {
            auto sources = random_vertices(mesh, count, count);
            sources.push_back(sources.front()); // given twice
            std::vector<std::vector<double>> alone;
            for (uint32_t s : sources) alone.push_back(field(mesh, *metric.make_solver(), {&s, 1}));
            const auto together = field(mesh, *solver, sources);
            size_t wrong_distance = 0, wrong_name = 0;
            for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
                double nearest = UNREACHABLE;
                for (const auto& d : alone) nearest = std::min(nearest, d[v]);
                if (nearest == UNREACHABLE) {
                    wrong_name += solver->nearest(v) != NONE;
                    wrong_distance += together[v] != UNREACHABLE;
                    continue;
                }
                wrong_distance += !(std::abs(together[v] - nearest) <= 1e-10 * nearest);
                const uint32_t named = solver->nearest(v);
                // Where two are equally near either will do.
                wrong_name += named >= sources.size() || !(alone[named][v] <= nearest * (1 + 1e-10));
            }
            CHECK(wrong_distance == 0);
            CHECK(wrong_name == 0);
            for (size_t i = 0; i < sources.size(); ++i) {
                CHECK(together[sources[i]] == 0);
                CHECK(sources[solver->nearest(sources[i])] == sources[i]);
            }
        }
        std::vector<uint32_t> all(mesh.vertex_count());
        std::iota(all.begin(), all.end(), 0u);
        CHECK(field(mesh, *solver, all) == std::vector<double>(all.size(), 0.0));
    }
}

TEST_CASE("exact: scaling the mesh scales the distances") {
    for (const auto& [name, soup] : surfaces()) {
        const auto& surface_name = name; // clang 14 captures no structured binding
        CAPTURE(surface_name);
        const uint32_t source = 5;
        const auto original = exact_field(mesh_of(soup), source);
        for (double scale : {1e-3, 1e3, 1e-30, 1e30}) {
            Soup scaled = soup;
            for (auto& p : scaled.positions) p *= scale;
            auto d = exact_field(mesh_of(scaled), source);
            for (double& value : d) value /= scale;
            CAPTURE(scale);
            CHECK(largest_relative_difference(d, original) < 1e-9);
        }
        // Powers of two change exponents only: not a bit may differ otherwise.
        for (int exponent : {-40, -3, 1, 50}) {
            Soup scaled = soup;
            for (auto& p : scaled.positions) p *= std::ldexp(1.0, exponent);
            auto d = exact_field(mesh_of(scaled), source);
            for (double& value : d) value = std::ldexp(value, -exponent);
            CHECK(d == original);
        }
    }
}

TEST_CASE("exact: moving, turning and mirroring the mesh changes nothing") {
    for (const auto& [name, soup] : surfaces()) {
        const auto& surface_name = name; // clang 14 captures no structured binding
        CAPTURE(surface_name);
        const auto original = exact_field(mesh_of(soup), 3);
        Eigen::Matrix3d turn = Eigen::AngleAxisd(1.234, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
        for (double mirror : {1.0, -1.0}) {
            Soup moved = soup;
            for (auto& p : moved.positions) p = turn * (mirror * p) + Vector3d(3, -7, 11);
            CHECK(largest_relative_difference(exact_field(mesh_of(moved), 3), original) < 1e-9);
        }
    }
}

TEST_CASE("exact: numbering, order and winding do not matter") {
    for (const auto& [name, soup] : surfaces()) {
        const auto& surface_name = name; // clang 14 captures no structured binding
        CAPTURE(surface_name);
        const auto original = exact_field(mesh_of(soup), 4);
        std::vector<uint32_t> new_id;
        const Soup renumbered = shuffled(soup, 21, new_id);
        const auto permuted = exact_field(mesh_of(renumbered), new_id[4]);
        std::vector<double> back;
        for (uint32_t id : new_id) back.push_back(permuted[id]);
        CHECK(largest_relative_difference(back, original) < 1e-9);
        CHECK(largest_relative_difference(exact_field(mesh_of(with_flipped_winding(soup)), 4), original) <
              1e-9);
        for (uint64_t seed : {1u, 2u, 3u})
            CHECK(largest_relative_difference(exact_field(mesh_of(with_mixed_winding(soup, seed)), 4),
                                              original) < 1e-9);
    }
}

TEST_CASE("exact: a finer triangulation of the same surface, the same distances") {
    for (const auto& [name, soup] : surfaces()) {
        const auto& surface_name = name; // clang 14 captures no structured binding
        CAPTURE(surface_name);
        // Each face in four, in its plane: the old vertices keep their ids.
        const Mesh coarse = mesh_of(soup);
        Soup fine{soup.positions, {}};
        for (const auto& [a, b] : coarse.edges)
            fine.positions.push_back((soup.positions[a] + soup.positions[b]) / 2);
        for (uint32_t f = 0; f < coarse.face_count(); ++f) {
            std::array<uint32_t, 3> middle = coarse.face_edges[f];
            for (uint32_t& e : middle) e += soup.vertex_count();
            for (size_t k = 0; k < 3; ++k)
                fine.triangles.push_back({coarse.faces[f][k], middle[(k + 2) % 3], middle[(k + 1) % 3]});
            fine.triangles.push_back(middle);
        }
        for (uint32_t s : random_vertices(coarse, 2, 4)) {
            auto d = exact_field(mesh_of(fine), s);
            d.resize(soup.positions.size());
            CHECK(largest_relative_difference(d, exact_field(coarse, s)) < 1e-9);
        }
    }
}

TEST_CASE("exact: other components are at infinity and have no nearest source") {
    const Soup first = sphere(2), second = cube(3);
    const Mesh mesh = mesh_of(joined(joined(first, second), grid(3, 3, 1, 1)));
    const auto solver = ExactMetric(mesh).make_solver();
    const uint32_t begin = first.vertex_count(), end = begin + second.vertex_count();
    const uint32_t source = begin + 4;
    const auto d = field(mesh, *solver, {&source, 1});
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        const bool inside = v >= begin && v < end;
        CHECK((d[v] < UNREACHABLE) == inside);
        CHECK(solver->nearest(v) == (inside ? 0 : NONE));
    }
    // The other components change nothing about the first.
    const auto alone = exact_field(mesh_of(second), 4);
    CHECK(std::equal(alone.begin(), alone.end(), d.begin() + begin));
    // A target that cannot be reached ends the solve all the same.
    const uint32_t unreachable = 0;
    CHECK(field(mesh, *solver, {&source, 1}, {&unreachable, 1})[0] == UNREACHABLE);
}

TEST_CASE("exact: through intake, with welded, unused and duplicate elements") {
    const Soup clean = bumpy_sphere(2, 6);
    // Every triangle with corners of its own, some twice, unused vertices in between.
    Soup soup;
    std::vector<uint32_t> an_id_of(clean.positions.size());
    for (size_t f = 0; f < clean.triangles.size(); ++f) {
        std::array<uint32_t, 3> ids{};
        for (size_t k = 0; k < 3; ++k) {
            soup.positions.push_back({1000.0 + static_cast<double>(f), 0, 0});
            soup.positions.push_back(clean.positions[clean.triangles[f][k]]);
            ids[k] = an_id_of[clean.triangles[f][k]] = soup.vertex_count() - 1;
        }
        soup.triangles.push_back(ids);
        if (f % 3 == 0) soup.triangles.push_back({ids[1], ids[0], ids[2]});
        if (f % 5 == 0) soup.triangles.push_back({ids[1], ids[1], ids[2]});
    }
    const Intake intake = take_in(view_of(soup), {});
    const auto expected = exact_field(mesh_of(clean), 2);
    const auto d = exact_field(intake.mesh, intake.vertex_of_id[an_id_of[2]]);
    std::vector<double> found;
    for (uint32_t id : an_id_of) found.push_back(d[intake.vertex_of_id[id]]);
    CHECK(largest_relative_difference(found, expected) < 1e-9);
}
