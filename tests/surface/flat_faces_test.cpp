// Points as those of the faces that flipping edges makes of planes.
#include "src/surface/flat_faces.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <doctest/doctest.h>

#include "src/mesh/flat_edges.h"
#include "tests/path/path_cases.h"
#include "tests/support/drilled_plate.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

using Faces = std::set<std::array<uint32_t, 3>>;

std::array<uint32_t, 3> in_order(std::array<uint32_t, 3> corners) {
    std::ranges::sort(corners);
    return corners;
}

Faces faces_of(const Mesh& mesh) {
    Faces faces;
    for (const auto& corners : mesh.faces) faces.insert(in_order(corners));
    return faces;
}

Eigen::Vector3d position(const Mesh& mesh, const std::array<uint32_t, 3>& corners,
                         const std::array<double, 3>& weights) {
    return weights[0] * mesh.positions[corners[0]] + weights[1] * mesh.positions[corners[1]] +
           weights[2] * mesh.positions[corners[2]];
}

// Inside of a face, on one of its edges, or in a corner.
std::array<double, 3> weights_of_kind(std::mt19937_64& random, size_t kind) {
    std::array<double, 3> weights;
    for (double& weight : weights) weight = uniform(random, 0, 1);
    const size_t zeros = kind % 4 == 0 ? 1 : kind % 4 == 1 ? 2 : 0;
    for (size_t k = 0; k < zeros; ++k) weights[(kind / 4 + k) % 3] = 0;
    const double sum = weights[0] + weights[1] + weights[2];
    for (double& weight : weights) weight /= sum;
    return weights;
}

}

TEST_CASE("flat faces: each point lies in one of those that edges were flipped for, at the same place") {
    std::mt19937_64 random(2);
    for (const Soup& whole : {jittered_grid(12, 1), cube(5), annulus(20, 2), l_shape(5), comb(1),
                              drilled_plate(3, 12, 0.1), with_mixed_winding(drilled_plate(2, 9, 0.5), 4)}) {
        const Mesh mesh = mesh_of(with_random_diagonals(whole, 20, 3));
        const auto flipped = flip_flat_edges(mesh);
        REQUIRE(flipped);
        const Faces before = faces_of(mesh), after = faces_of(flipped->mesh);
        const FlatFaces flat(flipped);
        size_t found = 0, replaced = 0;
        for (uint32_t f = 0; f < mesh.face_count(); ++f)
            for (size_t kind = 0; kind < 24; ++kind) {
                const auto& corners = mesh.faces[f];
                const auto weights = weights_of_kind(random, kind);
                const auto point = flat.find(mesh, {f, weights});
                replaced += flipped->plane_of_face[f] != NONE;
                if (!point) continue;
                ++found;
                REQUIRE(flipped->plane_of_face[f] != NONE);
                const auto& found_in = flat.corners(point->face);
                CHECK(after.contains(in_order(found_in)));
                CHECK(std::ranges::min(point->weights) >= 0);
                CHECK(point->weights[0] + point->weights[1] + point->weights[2] == doctest::Approx(1));
                CHECK((position(mesh, found_in, point->weights) - position(mesh, corners, weights)).norm() <
                      1e-7);
            }
        CHECK(replaced > 0);
        CHECK(found == replaced);
    }
}

// The same square twice, joined along its boundary. Inner vertices of both lie at the same places.
TEST_CASE("flat faces: of two sheets at one place, those of the point's own sheet") {
    Soup soup = with_random_diagonals(jittered_grid(10, 4), 20, 1);
    const uint32_t count = soup.vertex_count();
    std::vector<uint32_t> other(count);
    for (uint32_t v = 0; v < count; ++v) {
        const Eigen::Vector3d at = soup.positions[v];
        const bool is_inner = at.x() > 0 && at.x() < 1 && at.y() > 0 && at.y() < 1;
        other[v] = is_inner ? soup.vertex_count() : v;
        if (is_inner) soup.positions.push_back(at);
    }
    const Soup back = with_random_diagonals(jittered_grid(10, 4), 20, 9);
    const auto front_count = static_cast<uint32_t>(soup.triangles.size());
    for (const auto& [a, b, c] : back.triangles) soup.triangles.push_back({other[c], other[b], other[a]});
    const Mesh mesh = mesh_of(soup);
    const FlatFaces flat(flip_flat_edges(mesh));
    size_t found = 0;
    for (uint32_t f = 0; f < mesh.face_count(); ++f)
        if (const auto point = flat.find(mesh, {f, {0.3, 0.3, 0.4}})) {
            ++found;
            const bool is_front = f < front_count;
            for (const uint32_t corner : flat.corners(point->face))
                CHECK((corner < count ? is_front || other[corner] == corner : !is_front));
        }
    CHECK(found > mesh.face_count() / 2);
}

TEST_CASE("flat faces: straight lines are those that do not leave the plane") {
    size_t straight_ones = 0;
    for (const Soup& whole : {jittered_grid(9, 1), annulus(24, 2), l_shape(5), drilled_plate(2, 8, 0.4)}) {
        const PathCase on(with_random_diagonals(whole, 20, 3));
        const Mesh mesh = mesh_of(on.soup);
        const FlatFaces flat(flip_flat_edges(mesh));
        std::mt19937_64 random(1);
        for (size_t i = 0; i < 8000 / sparse(4); ++i) {
            const auto a = random_point(on.soup, random, 0), b = random_point(on.soup, random, 0);
            const SurfacePoint from{a.triangle, std::to_array(a.weights)},
                to{b.triangle, std::to_array(b.weights)};
            const double straight = flat.straight(mesh, from, to);
            CHECK(straight == flat.straight(mesh, to, from));
            const double exact = on.exact(a, b);
            if (!(straight < UNREACHABLE)) continue;
            ++straight_ones;
            CHECK(straight == doctest::Approx(exact).epsilon(1e-9));
            CHECK(on.sssd(a, b) == doctest::Approx(exact).epsilon(1e-6));
        }
    }
    CHECK(straight_ones > 20);
}

TEST_CASE("flat faces: none where there are no planes") {
    const Mesh mesh = mesh_of(sphere(2));
    CHECK(!FlatFaces(flip_flat_edges(mesh)).find(mesh, {5, {0.5, 0.25, 0.25}}));
}

TEST_CASE("flat faces: points of slivers are answered by the vertices around them" *
          doctest::skip(SANITIZED)) {
    const PathCase on(drilled_plate(4, 20, 0.02));
    std::mt19937_64 random(1);
    double sum = 0;
    const size_t count = 5000;
    for (size_t i = 0; i < count; ++i) {
        const auto a = random_point(on.soup, random, 0), b = random_point(on.soup, random, 0);
        sum += std::abs(on.sssd(a, b) / on.exact(a, b) - 1);
    }
    CHECK(sum / static_cast<double>(count) < 0.004);
}

namespace {

// A floor that is cut into slivers, and a ridge across it: two slopes from x = -1 and x = 1 up to x = 0. A
// vertex in the middle of either foot belongs to the floor's faces only, so that a face without area lies
// between floor and slope, which is flat with both.
Soup floor_with_ridge(double height) {
    Soup soup;
    const auto add = [&](double x, double y, double z) {
        soup.positions.push_back({x, y, z});
        return soup.vertex_count() - 1;
    };
    const auto triangle = [&](uint32_t a, uint32_t b, uint32_t c) { soup.triangles.push_back({a, b, c}); };
    const uint32_t top_0 = add(0, 0, height), top_1 = add(0, 1, height);
    for (const double side : {-1.0, 1.0}) {
        const uint32_t foot_0 = add(side, 0, 0), foot_1 = add(side, 1, 0), middle = add(side, 0.4, 0);
        triangle(top_0, foot_0, foot_1);
        triangle(top_0, foot_1, top_1);
        triangle(foot_0, middle, foot_1);
        // A fan around a far corner, over a rim of many vertices.
        std::vector<uint32_t> rim{foot_1, middle, foot_0};
        for (uint32_t i = 1; i <= 12; ++i) rim.push_back(add(side * (1 + 0.5 * i), 0, 0));
        const uint32_t far = add(side * 7, 1, 0);
        for (size_t i = 1; i < rim.size(); ++i) triangle(far, rim[i - 1], rim[i]);
    }
    return soup;
}

}

TEST_CASE("flat faces: a straight line in a plane does not pass under a ridge, nor through a thin plate") {
    for (const Soup& soup : {floor_with_ridge(2), floor_with_ridge(0.05), drilled_plate(2, 16, 1e-4),
                             drilled_plate(1, 40, 1e-3)}) {
        const PathCase on(soup);
        const Mesh mesh = mesh_of(on.soup);
        const FlatFaces flat(flip_flat_edges(mesh));
        std::mt19937_64 random(4);
        for (size_t i = 0; i < 6000 / sparse(4); ++i) {
            const auto a = random_point(on.soup, random, i), b = random_point(on.soup, random, i / 4);
            const SurfacePoint from{a.triangle, std::to_array(a.weights)},
                to{b.triangle, std::to_array(b.weights)};
            const double straight = flat.straight(mesh, from, to), exact = on.exact(a, b);
            CHECK(straight == flat.straight(mesh, to, from));
            if (straight < UNREACHABLE) CHECK(straight == doctest::Approx(exact).epsilon(2e-6));
        }
    }
}
