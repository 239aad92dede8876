#include "src/tables/borders.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include <doctest/doctest.h>

#include "src/metric/edge_graph.h"
#include "tests/support/meshes.h"
#include "tests/support/oracles.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

using Faces = std::vector<uint32_t>;
using Edge = std::array<uint32_t, 2>;

std::vector<std::vector<uint32_t>> walks(const Mesh& mesh, const Faces& faces) {
    std::vector<uint8_t> inside(mesh.face_count(), 0);
    for (uint32_t f : faces) inside[f] = 1;
    return walk_border(mesh, faces, inside);
}

std::vector<uint32_t> walk(const Mesh& mesh, const Faces& faces) {
    std::vector<uint32_t> all;
    for (const auto& walk : walks(mesh, faces)) all.insert(all.end(), walk.begin(), walk.end());
    return all;
}

// Edges with one face of the patch, and one of others.
std::set<Edge> border_of(const Mesh& mesh, const Faces& faces) {
    std::map<Edge, int> count, count_of_all;
    const auto add = [&](uint32_t f, std::map<Edge, int>& counted) {
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = mesh.faces[f][k], b = mesh.faces[f][(k + 1) % 3];
            ++counted[{std::min(a, b), std::max(a, b)}];
        }
    };
    for (uint32_t f : faces) add(f, count);
    for (uint32_t f = 0; f < mesh.face_count(); ++f) add(f, count_of_all);
    std::set<Edge> border;
    for (const auto& [edge, faces_there] : count)
        if (faces_there == 1 && count_of_all[edge] == 2) border.insert(edge);
    return border;
}

// Checks a walk over a border of simple rings: each vertex once, ring by ring, each from its smallest
// vertex, along edges, and back to where it began. Returns the number of rings.
uint32_t check_rings(const Mesh& mesh, const Faces& faces) {
    const auto border = border_of(mesh, faces);
    const auto order = walk(mesh, faces);
    std::set<uint32_t> expected;
    for (const auto& [a, b] : border) expected.insert({a, b});
    CHECK(order.size() == expected.size());
    CHECK(std::set(order.begin(), order.end()) == expected);
    const auto adjacent = [&](uint32_t a, uint32_t b) {
        return border.contains({std::min(a, b), std::max(a, b)});
    };
    uint32_t rings = 0, start = 0;
    for (size_t i = 0; i < order.size();) {
        size_t end = i + 1;
        while (end < order.size() && adjacent(order[end - 1], order[end])) ++end;
        CHECK(end - i >= 3);
        CHECK(adjacent(order[end - 1], order[i]));
        CHECK(order[i] == *std::min_element(order.begin() + static_cast<long>(i),
                                            order.begin() + static_cast<long>(end)));
        if (rings > 0) CHECK(order[i] > start); // rings by their smallest vertex
        start = order[i];
        ++rings;
        i = end;
    }
    return rings;
}

}

TEST_CASE("walk_border: one ring, two rings, none") {
    std::vector<uint32_t> unused;
    const Mesh plane = mesh_of(shuffled(grid(9, 9, 1, 1), 4, unused));
    Faces all(plane.face_count());
    std::iota(all.begin(), all.end(), 0u);
    CHECK(walk(plane, all).empty()); // the mesh's own boundary is no border

    const Mesh closed = mesh_of(sphere(2));
    Faces ball(closed.face_count());
    std::iota(ball.begin(), ball.end(), 0u);
    CHECK(walk(closed, ball).empty());
    ball.pop_back();
    CHECK(check_rings(closed, ball) == 1);

    const Mesh square = mesh_of(grid(9, 9, 1, 1));
    Faces frame; // all cells but the outermost ones and the one in the middle
    for (uint32_t y = 1; y < 8; ++y)
        for (uint32_t x = 1; x < 8; ++x)
            if (x != 4 || y != 4)
                for (uint32_t k : {0u, 1u}) frame.push_back(2 * (x + y * 9) + k);
    CHECK(check_rings(square, frame) == 2);
    CHECK(walk(square, frame).size() == 28 + 4);
}

TEST_CASE("walk_border: from the smallest vertex to the smaller of its neighbours") {
    const Mesh mesh = mesh_of(grid(4, 3, 4, 3));
    //  15 16 17 18 19
    //  10 11 12 13 14
    //   5  6  7  8  9
    //   0  1  2  3  4
    CHECK(walk(mesh, {10, 11, 12, 13}) == std::vector<uint32_t>{6, 7, 8, 13, 12, 11});
}

// It may pass two corners of the mesh, and begin between them.
TEST_CASE("walk_border: where it ends at the mesh's boundary it is one walk, from end to end") {
    std::vector<uint32_t> number;
    for (uint64_t seed = 1; seed < 9; ++seed) {
        const Mesh mesh = mesh_of(shuffled(grid(6, 5, 6, 5), seed, number));
        Faces half;
        for (uint32_t f = 0; f < mesh.face_count(); ++f) {
            double x = 0;
            for (uint32_t v : mesh.faces[f]) x += mesh.positions[v][0];
            if (x < 3 * 3) half.push_back(f);
        }
        const auto border = border_of(mesh, half);
        const auto all = walks(mesh, half);
        REQUIRE(all.size() == 1);
        CHECK(all[0].size() == 6);
        for (size_t i = 0; i + 1 < all[0].size(); ++i)
            CHECK(border.contains({std::min(all[0][i], all[0][i + 1]), std::max(all[0][i], all[0][i + 1])}));
    }
}

TEST_CASE("walk_border: rings that touch in a vertex are walked through, each vertex once") {
    const Mesh mesh = mesh_of(grid(8, 8, 1, 1));
    Faces faces; // three cells in a diagonal
    for (uint32_t i : {1u, 2u, 3u})
        for (uint32_t k : {0u, 1u}) faces.push_back(2 * (i + i * 8) + k);
    const auto order = walk(mesh, faces);
    CHECK(std::set(order.begin(), order.end()).size() == order.size());
    CHECK(order.size() == 10); // 3 * 4 corners, two of them shared
    CHECK(order.front() == 10);
}

// Of the middle ring the shared vertices are taken; what is left of it begins at an end, not at its smallest
// vertex.
TEST_CASE("walk_border: what is left of a ring is one walk, from end to end") {
    const Mesh mesh = mesh_of(grid(8, 8, 1, 1));
    Faces faces; // two squares of 2 x 2 and 3 x 3 cells that share a corner, 40
    for (uint32_t y = 2; y < 7; ++y)
        for (uint32_t x = 2; x < 7; ++x)
            if ((x < 4 && y < 4) || (x >= 4 && y >= 4))
                for (uint32_t k : {0u, 1u}) faces.push_back(2 * (x + y * 8) + k);
    const auto border = border_of(mesh, faces);
    size_t vertices = 0;
    for (const auto& walk : walks(mesh, faces)) {
        vertices += walk.size();
        for (size_t i = 0; i + 1 < walk.size(); ++i)
            CHECK(border.contains({std::min(walk[i], walk[i + 1]), std::max(walk[i], walk[i + 1])}));
    }
    CHECK(vertices == 8 + 12 - 1);
    CHECK(walks(mesh, faces).size() == 2);
}

TEST_CASE("leaves_at_vertices: the leaves of the faces around, ascending") {
    const Mesh mesh = mesh_of(bumpy_sphere(2, 1));
    const EdgeGraphMetric metric(mesh, edge_lengths(mesh));
    Workers workers(metric, 1, {});
    const Hierarchy h = build_hierarchy(mesh, {{5, 4}, 2, 3}, workers);
    const auto leaves = leaves_at_vertices(mesh, h);
    REQUIRE(leaves.size() == mesh.vertex_count());
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        std::set<uint32_t> expected;
        for (uint32_t f = 0; f < mesh.face_count(); ++f)
            if (std::count(mesh.faces[f].begin(), mesh.faces[f].end(), v)) expected.insert(h.leaf_of_face[f]);
        CHECK(std::vector(leaves[v].begin(), leaves[v].end()) ==
              std::vector(expected.begin(), expected.end()));
    }
}

TEST_CASE("common_ancestor: the deepest patch above all the leaves, against brute force") {
    const Mesh mesh = mesh_of(bumpy_sphere(3, 2));
    const EdgeGraphMetric metric(mesh, edge_lengths(mesh));
    Workers workers(metric, 1, {});
    const Hierarchy h = build_hierarchy(mesh, {{4, 3, 3}, 1, 2}, workers);
    const auto path_up = [&](uint32_t patch) {
        std::vector<uint32_t> path;
        for (; patch != NONE; patch = h.parent[patch]) path.push_back(patch);
        return path; // deepest first
    };
    std::mt19937_64 random(1);
    const uint32_t leaf_count = h.patch_count() - h.first_leaf();
    for (int i = 0; i < 2000; ++i) {
        std::set<uint32_t> leaves;
        const uint32_t near = static_cast<uint32_t>(random() % leaf_count);
        for (uint64_t k = 0; k <= random() % 4; ++k)
            leaves.insert(h.first_leaf() +
                          std::min(leaf_count - 1, near + static_cast<uint32_t>(random() % 8)));
        uint32_t expected = NONE;
        for (uint32_t candidate : path_up(*leaves.begin())) {
            const bool above_all = std::all_of(leaves.begin(), leaves.end(), [&](uint32_t leaf) {
                const auto path = path_up(leaf);
                return std::find(path.begin(), path.end(), candidate) != path.end();
            });
            if (!above_all) continue;
            expected = candidate;
            break;
        }
        CHECK(common_ancestor(h, std::vector(leaves.begin(), leaves.end())) == expected);
    }
}
