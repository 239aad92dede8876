#include "src/mesh/components.h"
#include "src/partition/shorten_borders.h"

#include <algorithm>
#include <numeric>
#include <set>

#include <doctest/doctest.h>

#include "src/metric/edge_graph.h"
#include "src/metric/window_propagation.h"
#include "src/partition/patch.h"
#include "src/partition/poisson_disk.h"
#include "src/partition/voronoi.h"
#include "tests/support/meshes.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

std::vector<uint32_t> faces_of(const Mesh& mesh) {
    std::vector<uint32_t> faces(mesh.face_count());
    std::iota(faces.begin(), faces.end(), 0u);
    return faces;
}

std::vector<uint32_t> edges_between_cells(const Mesh& mesh, const std::vector<uint32_t>& cell) {
    std::vector<uint32_t> edges;
    for (uint32_t e = 0; e < mesh.edge_count(); ++e) {
        const auto faces = mesh.edge_faces[e];
        if (faces.size() == 2 && cell[faces[0]] != cell[faces[1]]) edges.push_back(e);
    }
    return edges;
}

// Each edge counts as one, and by the square of its length.
double cost_of_borders(const Mesh& mesh, const std::vector<uint32_t>& cell) {
    double lengths = 0;
    for (const auto& face : mesh.face_edges)
        for (const uint32_t e : face) lengths += mesh.edge_length(e);
    const double average = lengths / (3 * mesh.face_count());
    double cost = 0;
    for (const uint32_t e : edges_between_cells(mesh, cell)) {
        const double share = mesh.edge_length(e) / average;
        cost += 1 + share * share;
    }
    return cost;
}

// columns x rows cells of two triangles, whose diagonals alternate.
Soup alternating_grid(uint32_t columns, uint32_t rows, double width, double height) {
    Soup soup = grid(columns, rows, width, height);
    for (uint32_t y = 0; y < rows; ++y)
        for (uint32_t x = 0; x < columns; ++x) {
            const uint32_t a = x + y * (columns + 1), b = a + 1, c = a + columns + 1, d = c + 1;
            const bool rises = (x + y) % 2 == 0;
            const size_t first = 2 * (x + size_t{y} * columns);
            soup.triangles[first] = {a, b, rises ? d : c};
            soup.triangles[first + 1] = {rises ? a : b, d, c};
        }
    return soup;
}

// Per face: 0 below a row of cells, 1 above it, and in the row by whether one side of the face is the
// lower side of the row.
std::vector<uint32_t> parted_by_teeth(const Mesh& mesh, uint32_t columns, uint32_t row) {
    std::vector<uint32_t> cell(mesh.face_count());
    for (uint32_t f = 0; f < cell.size(); ++f) {
        const uint32_t row_of_face = f / 2 / columns;
        cell[f] = row_of_face < row ? 0 : row_of_face > row ? 1 : f % 2;
    }
    return cell;
}

}

TEST_CASE("shortened borders: teeth between two halves become a line") {
    constexpr uint32_t COLUMNS = 20, ROWS = 10;
    for (const Soup& soup : {grid(COLUMNS, ROWS, 1, 1), alternating_grid(COLUMNS, ROWS, 1, 1),
                             alternating_grid(COLUMNS, ROWS, 1, 40)}) {
        const Mesh mesh = mesh_of(soup);
        auto cell = parted_by_teeth(mesh, COLUMNS, ROWS / 2);
        CHECK(edges_between_cells(mesh, cell).size() >= COLUMNS);
        CHECK(cost_of_borders(mesh, cell) > 1.5 * COLUMNS);
        shorten_borders(mesh, edge_lengths(mesh), faces_of(mesh), cell);
        const auto edges = edges_between_cells(mesh, cell);
        CHECK(edges.size() == COLUMNS);
        for (const uint32_t e : edges) CHECK(mesh.edge_length(e) == doctest::Approx(1.0 / COLUMNS));
    }
}

TEST_CASE("shortened borders: cheaper borders between Voronoi cells, which keep their inner faces") {
    for (const Soup& soup :
         {bumpy_sphere(4, 1), torus(40, 20, 2, 0.7), jittered_grid(30, 3), annulus(40, 8), comb(5)}) {
        const Mesh mesh = mesh_of(soup);
        const auto faces = faces_of(mesh);
        const auto solver = ExactMetric(mesh).make_solver();
        Random random(5);
        auto seeds = poisson_disk_samples(*solver, components_of(mesh).of_vertex, vertices_of(mesh, faces),
                                          12, random);
        const auto before = voronoi_cells(*solver, mesh, faces, seeds);
        auto cell = before;
        shorten_borders(mesh, edge_lengths(mesh), faces, cell);
        CHECK(cost_of_borders(mesh, cell) < 0.9 * cost_of_borders(mesh, before));
        CHECK(edges_between_cells(mesh, cell).size() < edges_between_cells(mesh, before).size());
        // The faces around the vertices that are farthest from all borders.
        relax_seeds(*solver, mesh, faces, before, seeds);
        for (const uint32_t seed : seeds)
            for (const uint32_t f : mesh.vertex_faces[seed]) CHECK(cell[f] == before[f]);
    }
}

TEST_CASE("shortened borders: what has no cell, or lies beyond the patch, stays") {
    const Mesh mesh = mesh_of(grid(3, 3, 1, 1));
    const std::vector<uint32_t> one_square{8, 9}; // the one in the middle
    std::vector<uint32_t> cell{3, 4};
    shorten_borders(mesh, edge_lengths(mesh), one_square, cell);
    CHECK(cell == std::vector<uint32_t>{3, 4});

    const auto faces = faces_of(mesh);
    std::vector<uint32_t> lone(faces.size(), 7);
    lone[9] = 2;
    auto kept = lone;
    shorten_borders(mesh, edge_lengths(mesh), faces, kept);
    CHECK(kept == lone);

    auto none = parted_by_teeth(mesh, 3, 1);
    for (const uint32_t f : {0u, 9u, 17u}) none[f] = NONE;
    shorten_borders(mesh, edge_lengths(mesh), faces, none);
    for (uint32_t f = 0; f < none.size(); ++f) CHECK((none[f] == NONE) == (f == 0 || f == 9 || f == 17));
}

TEST_CASE("shortened borders: lengths that are given count, whatever the positions") {
    constexpr uint32_t COLUMNS = 20, ROWS = 10;
    const Mesh narrow = mesh_of(alternating_grid(COLUMNS, ROWS, 1, 40)),
               wide = mesh_of(alternating_grid(COLUMNS, ROWS, 40, 1));
    std::vector<uint32_t> by_own; // parted by a diagonal of the grid
    for (uint32_t f = 0; f < narrow.face_count(); ++f)
        by_own.push_back(f / 2 % COLUMNS * ROWS + f / 2 / COLUMNS * COLUMNS < ROWS * COLUMNS);
    auto by_given = by_own, by_positions = by_own;
    shorten_borders(narrow, edge_lengths(narrow), faces_of(narrow), by_own);
    shorten_borders(wide, edge_lengths(narrow), faces_of(wide), by_given);
    CHECK(by_given == by_own);
    shorten_borders(wide, edge_lengths(wide), faces_of(wide), by_positions);
    CHECK(by_positions != by_own);
}
