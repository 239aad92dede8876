#include "src/mesh/mesh.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <string>

#include <doctest/doctest.h>

#include "tests/support/meshes.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

using Edge = std::array<uint32_t, 2>;

std::vector<Soup> all_kinds() {
    std::vector<uint32_t> unused;
    Soup triangle;
    triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    triangle.triangles = {{2, 0, 1}};
    return {triangle,
            grid(3, 2, 1, 1),
            shuffled(torus(6, 5, 2, 0.5), 1, unused),
            with_mixed_winding(sphere(2), 2),
            joined(cube(2), annulus(6, 2)),
            pinched_sheets(2),
            moebius(8, 2)};
}

}

TEST_CASE("connect: edges, faces at edges and faces at vertices, against brute force") {
    for (const Soup& soup : all_kinds()) {
        const Mesh mesh = mesh_of(soup);
        std::map<Edge, std::set<uint32_t>> faces_of;
        for (uint32_t f = 0; f < mesh.face_count(); ++f)
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t a = mesh.faces[f][(k + 1) % 3], b = mesh.faces[f][(k + 2) % 3];
                const Edge edge{std::min(a, b), std::max(a, b)};
                faces_of[edge].insert(f);
                CHECK(mesh.edges.at(mesh.face_edges[f][k]) == edge); // opposite to corner k
            }
        REQUIRE(mesh.edges.size() == faces_of.size());
        REQUIRE(mesh.edge_faces.size() == faces_of.size());
        for (uint32_t e = 0; e < mesh.edge_count(); ++e) {
            const auto faces = mesh.edge_faces[e];
            CHECK(std::set(faces.begin(), faces.end()) == faces_of.at(mesh.edges[e]));
            CHECK(faces.size() == faces_of.at(mesh.edges[e]).size());
            const auto& [a, b] = mesh.edges[e];
            CHECK(mesh.edge_length(e) ==
                  doctest::Approx((mesh.positions[a] - mesh.positions[b]).norm()).epsilon(1e-15));
        }
        REQUIRE(mesh.vertex_faces.size() == mesh.vertex_count());
        for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
            std::vector<uint32_t> expected;
            for (uint32_t f = 0; f < mesh.face_count(); ++f)
                if (std::count(mesh.faces[f].begin(), mesh.faces[f].end(), v)) expected.push_back(f);
            const auto faces = mesh.vertex_faces[v];
            CHECK(std::vector(faces.begin(), faces.end()) == expected);
        }
    }
}

TEST_CASE("find_edge: every pair of vertices, in both orders") {
    for (const Soup& soup : all_kinds()) {
        const Mesh mesh = mesh_of(soup);
        std::map<Edge, uint32_t> number;
        for (uint32_t e = 0; e < mesh.edge_count(); ++e) number[mesh.edges[e]] = e;
        size_t wrong = 0;
        for (uint32_t a = 0; a < mesh.vertex_count(); ++a)
            for (uint32_t b = 0; b < mesh.vertex_count(); ++b) {
                const auto found = number.find({std::min(a, b), std::max(a, b)});
                wrong += find_edge(mesh, a, b) != (found == number.end() ? NONE : found->second);
            }
        CHECK(wrong == 0);
    }
}

TEST_CASE("connect: a second time after the faces changed, nothing is left of the first") {
    Mesh mesh = mesh_of(cube(2));
    mesh.faces.resize(5);
    connect(mesh);
    Mesh fresh;
    fresh.positions = mesh.positions;
    fresh.faces = mesh.faces;
    connect(fresh);
    CHECK(mesh.edges == fresh.edges);
    CHECK(mesh.edge_faces.items == fresh.edge_faces.items);
    CHECK(mesh.edge_faces.begin == fresh.edge_faces.begin);
    CHECK(mesh.face_edges == fresh.face_edges);
    CHECK(mesh.vertex_faces.items == fresh.vertex_faces.items);
    CHECK(mesh.edge_faces.items.size() == 15);
}

TEST_CASE("group_by: keeps the order within a group, has empty groups") {
    std::mt19937_64 random(3);
    std::vector<uint32_t> keys(200);
    for (uint32_t& key : keys) key = static_cast<uint32_t>(random() % 17) * 2; // odd groups stay empty
    const auto groups = group_by(keys, 40);
    REQUIRE(groups.size() == 40);
    for (uint32_t g = 0; g < 40; ++g) {
        std::vector<uint32_t> expected;
        for (uint32_t i = 0; i < keys.size(); ++i)
            if (keys[i] == g) expected.push_back(i);
        CHECK(std::vector(groups[g].begin(), groups[g].end()) == expected);
    }
    CHECK(group_by({}, 3).size() == 3);
    CHECK(group_by({}, 0).size() == 0);
}
