#include "src/mesh/flat_edges.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <Eigen/Geometry>

#include <doctest/doctest.h>

#include "tests/support/drilled_plate.h"
#include "tests/support/meshes.h"
#include "tests/support/oracles.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

constexpr uint32_t ROUNDS = 20;

Mesh flipped(const Soup& soup) {
    const auto flipped = flip_flat_edges(mesh_of(soup));
    REQUIRE(flipped);
    return flipped->mesh;
}

// The corners of each face in the order of their numbers.
std::set<std::array<uint32_t, 3>> faces_of(const Mesh& mesh) {
    std::set<std::array<uint32_t, 3>> faces;
    for (auto corners : mesh.faces) {
        std::ranges::sort(corners);
        faces.insert(corners);
    }
    CHECK(faces.size() == mesh.faces.size());
    return faces;
}

// Faces of one mesh that the other one does not have: four corners may lie on one circle, or nearly so.
double share_of_others(const Mesh& mesh, const Mesh& other) {
    const auto known = faces_of(other);
    const auto others =
        std::ranges::count_if(faces_of(mesh), [&](const auto& face) { return !known.contains(face); });
    return static_cast<double>(others) / mesh.face_count();
}

Eigen::Vector3d area_vector(const Mesh& mesh, uint32_t face) {
    const auto& [a, b, c] = mesh.faces[face];
    return (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]) / 2;
}

double area_of(const Mesh& mesh) {
    double area = 0;
    for (uint32_t f = 0; f < mesh.face_count(); ++f) area += area_vector(mesh, f).norm();
    return area;
}

// Two squares at a right angle, of which only the second one has the vertex in the middle of the crease:
// between them lies a face without area, which is flat with either.
Soup crease_with_cap() {
    Soup soup;
    soup.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 1}, {0, 0, 1}, {0.4, 0, 0}};
    soup.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 6, 1}, {6, 0, 5}, {6, 5, 4}, {6, 4, 1}};
    return soup;
}

// Turned about no axis in particular, and rounded as files of floats have it: planes are no longer exactly
// flat.
Soup turned(Soup soup) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
    for (auto& p : soup.positions) p = (turn * p + Eigen::Vector3d(3, 1, -2)).cast<float>().cast<double>();
    return soup;
}

// In the plane z = 0: positive if d is outside of the circle through the corners, which lie counterclockwise.
double outside_circle(const Mesh& mesh, const std::array<uint32_t, 3>& face, uint32_t d) {
    Eigen::Matrix3d rows;
    for (int i = 0; i < 3; ++i) {
        const Eigen::Vector3d to = mesh.positions[face[static_cast<size_t>(i)]] - mesh.positions[d];
        rows.row(i) << to.x(), to.y(), to.x() * to.x() + to.y() * to.y();
    }
    return -rows.determinant();
}

}

TEST_CASE("flat edges: a convex plane becomes its Delaunay triangulation, however it was cut") {
    for (const uint64_t seed : {1u, 2u, 3u}) {
        const Soup plane = jittered_grid(12, 7 * seed);
        const Mesh mesh = flipped(with_random_diagonals(plane, ROUNDS, seed));
        CHECK(share_of_others(mesh, flipped(with_random_diagonals(plane, 2, seed + 100))) < 0.03);
        CHECK(area_of(mesh) == doctest::Approx(1));
        for (const auto& face : mesh.faces)
            for (uint32_t v = 0; v < mesh.vertex_count(); ++v)
                if (!std::ranges::count(face, v)) CHECK(outside_circle(mesh, face, v) > -1e-7);
    }
}

// By their angles all triangulations of a coin's cap are alike; in a fan, paths cross many edges. Whichever
// corner of a tree of chords has most of them has two on each of its levels, and the edges of the rim.
TEST_CASE("flat edges: a fan of corners on a circle becomes a tree of chords, straight or turned") {
    constexpr uint32_t CORNERS = 256, LEVELS = 8;
    Soup fan;
    for (uint32_t i = 0; i < CORNERS; ++i) {
        const double turn = 2 * std::numbers::pi * i / CORNERS;
        fan.positions.push_back({std::cos(turn), std::sin(turn), 0});
        if (i >= 2) fan.triangles.push_back({0, i - 1, i});
    }
    const double area = CORNERS / 2.0 * std::sin(2 * std::numbers::pi / CORNERS);
    for (const Soup& soup : {fan, turned(fan)}) {
        const Mesh mesh = flipped(soup);
        CHECK(area_of(mesh) == doctest::Approx(area));
        for (uint32_t v = 0; v < CORNERS; ++v) CHECK(mesh.vertex_faces[v].size() <= 2 * LEVELS + 1);
    }
}

TEST_CASE("flat edges: distances stay, creases and boundaries do, and faces keep their side") {
    for (const Soup& whole : {jittered_grid(7, 1), cube(4), annulus(9, 3), l_shape(4), comb(1),
                              joined(cube(3), jittered_grid(4, 9))}) {
        const Soup soup = turned(with_random_diagonals(whole, ROUNDS, 5));
        const Mesh before = mesh_of(soup), after = flipped(soup);
        REQUIRE(after.vertex_count() == before.vertex_count());
        CHECK(after.face_count() == before.face_count());
        CHECK(after.edge_count() == before.edge_count());
        CHECK(area_of(after) == doctest::Approx(area_of(before)));
        for (uint32_t e = 0; e < before.edge_count(); ++e) {
            const auto [a, b] = before.edges[e];
            if (before.edge_faces[e].size() != 2) {
                REQUIRE(find_edge(after, a, b) != NONE);
                CHECK(after.edge_faces[find_edge(after, a, b)].size() == before.edge_faces[e].size());
            }
        }
        for (uint32_t source = 0; source < before.vertex_count(); source += 3)
            CHECK(largest_relative_difference(exact_field(before, source), exact_field(after, source)) <
                  1e-6);
    }
}

TEST_CASE("flat edges: a face without area in a crease belongs to one side or the other") {
    for (const uint32_t factor : {1u, 20u}) {
        Soup soup = crease_with_cap();
        for (auto& p : soup.positions) p.x() *= factor;
        const Mesh before = mesh_of(soup);
        const auto after = flip_flat_edges(before);
        if (!after) continue;
        for (uint32_t source = 0; source < before.vertex_count(); ++source)
            CHECK(largest_relative_difference(exact_field(before, source), exact_field(after->mesh, source)) <
                  1e-6);
        CHECK(area_of(after->mesh) == doctest::Approx(area_of(before)));
    }
}

TEST_CASE("flat edges: edges of a closed box stay, and sides that face outwards do so afterwards") {
    const auto made = flip_flat_edges(mesh_of(with_random_diagonals(cube(5), ROUNDS, 3)));
    REQUIRE(made);
    const Mesh& mesh = made->mesh;
    const Eigen::Vector3d middle(0.5, 0.5, 0.5);
    for (const auto& [a, b, c] : mesh.faces) {
        const auto& at = mesh.positions;
        CHECK((at[b] - at[a]).cross(at[c] - at[a]).dot(at[a] - middle) > 0);
    }
    // No edge of a lattice of squares is longer than the diagonal of one of them.
    size_t flipped_faces = 0;
    for (uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (made->plane_of_face[f] == NONE) continue;
        ++flipped_faces;
        for (const uint32_t e : mesh.face_edges[f]) CHECK(mesh.edge_length(e) < 0.2 * std::sqrt(2) + 1e-9);
    }
    CHECK(flipped_faces > mesh.face_count() / 2);
}

TEST_CASE("flat edges: faces whose windings disagree are one plane as well") {
    const Soup plane = jittered_grid(9, 4);
    const Mesh mesh = flipped(with_mixed_winding(with_random_diagonals(plane, ROUNDS, 1), 8));
    CHECK(share_of_others(mesh, flipped(with_random_diagonals(plane, ROUNDS, 2))) < 0.03);
}

TEST_CASE("flat edges: a face without area in a seam of vertices becomes two that have one") {
    Soup soup;
    soup.positions = {{0, 0, 0}, {1, 0, 0}, {0.4, 0, 0}, {0.5, -0.3, 0}, {0.5, 0.3, 0}};
    soup.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 2, 4}, {2, 1, 4}};
    const Mesh mesh = flipped(soup);
    CHECK(faces_of(mesh) == std::set<std::array<uint32_t, 3>>{{0, 2, 3}, {1, 2, 3}, {0, 2, 4}, {1, 2, 4}});
}

TEST_CASE("flat edges: nothing is flipped where nothing is to be") {
    CHECK(!flip_flat_edges(mesh_of(grid(4, 5, 1, 1))));       // ties
    CHECK(!flip_flat_edges(mesh_of(grid(4, 5, 100, 1))));     // ties
    CHECK(!flip_flat_edges(mesh_of(sphere(3))));              // no planes
    CHECK(!flip_flat_edges(mesh_of(torus(20, 12, 2, 1))));    // round enough
    CHECK(!flip_flat_edges(mesh_of(delaunay_square(60, 3)))); // Delaunay already
    CHECK(!flip_flat_edges(mesh_of(jittered_grid(20, 3))));   // nearly so
    for (const double bend : {0.001, 0.3, 3.1}) {             // a crease along the long diagonal of a rhombus
        Soup soup;
        soup.positions = {
            {-2, 0, 0}, {2, 0, 0}, {0, 0.5, 0}, {0, -0.5 * std::cos(bend), 0.5 * std::sin(bend)}};
        soup.triangles = {{0, 1, 2}, {1, 0, 3}};
        CHECK(!flip_flat_edges(mesh_of(soup)));
    }
}

TEST_CASE("flat edges: nothing is flipped in a plane that covers itself") {
    for (const uint32_t turns : {1u, 2u}) {
        const Mesh mesh = mesh_of(with_random_diagonals(flat_fan(turns), ROUNDS, 3));
        CHECK(flip_flat_edges(mesh).has_value() == (turns == 1));
    }
}

TEST_CASE("flat edges: an edge stays if the other diagonal is an edge already") {
    Soup soup;
    soup.positions = {{-2, 0, 0}, {2, 0, 0}, {0, 0.5, 0}, {0, -0.5, 0}, {0, 0, 1}};
    soup.triangles = {{0, 1, 2}, {1, 0, 3}};
    CHECK(flip_flat_edges(mesh_of(Soup{{soup.positions.begin(), soup.positions.end() - 1}, soup.triangles})));
    soup.triangles.push_back({2, 3, 4});
    CHECK(!flip_flat_edges(mesh_of(soup)));
}

TEST_CASE("flat edges: two flat caps on one edge become round, however flat they are") {
    for (const double height : {0.1, 1e-3, 1e-4, 1e-5, 1e-7}) {
        Soup soup;
        soup.positions = {{0, 0, 0}, {1, 0, 0}, {0.4, height, 0}, {0.6, -height, 0}};
        soup.triangles = {{0, 1, 2}, {1, 0, 3}};
        CHECK(faces_of(flipped(soup)) == std::set<std::array<uint32_t, 3>>{{0, 2, 3}, {1, 2, 3}});
    }
}

TEST_CASE("flat edges: a crease between two narrow strips stays") {
    for (const double bend : {0.01, 0.5, 1.57, 3.0})
        for (const double width : {1e-2, 1e-4, 1e-6}) {
            Soup soup;
            soup.positions = {{0, 0, 0},
                              {1, 0, 0},
                              {0.01, width, 0},
                              {0.75, -width * std::cos(bend), width * std::sin(bend)}};
            soup.triangles = {{0, 1, 2}, {1, 0, 3}};
            CHECK(!flip_flat_edges(mesh_of(soup)));
        }
}

TEST_CASE("flat edges: a plane has the same area in both meshes") {
    for (const Soup& whole : {jittered_grid(9, 2), cube(5), comb(1), drilled_plate(3, 12, 0.1),
                              joined(annulus(20, 2), l_shape(5))}) {
        const Mesh mesh = mesh_of(with_random_diagonals(whole, ROUNDS, 6));
        const auto made = flip_flat_edges(mesh);
        REQUIRE(made);
        std::map<uint32_t, Eigen::Vector3d> area;
        for (uint32_t f = 0; f < mesh.face_count(); ++f) {
            const uint32_t plane = made->plane_of_face[f];
            if (plane == NONE)
                CHECK(made->mesh.faces[f] == mesh.faces[f]);
            else
                area.try_emplace(plane, Eigen::Vector3d::Zero()).first->second +=
                    area_vector(made->mesh, f) - area_vector(mesh, f);
        }
        CHECK(!area.empty());
        for (const auto& [plane, difference] : area) CHECK(difference.norm() < 1e-12);
    }
}
