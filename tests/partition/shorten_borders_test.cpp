#include "src/partition/straighten.h"

#include <algorithm>
#include <numeric>
#include <set>

#include <doctest/doctest.h>

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

size_t edges_between_cells(const Mesh& mesh, const std::vector<uint32_t>& cell) {
    size_t edges = 0;
    for (uint32_t e = 0; e < mesh.edge_count(); ++e) {
        const auto faces = mesh.edge_faces[e];
        edges += faces.size() == 2 && cell[faces[0]] != cell[faces[1]];
    }
    return edges;
}

}

TEST_CASE("straightened borders: a sawtooth between two halves becomes a line") {
    constexpr uint32_t COLUMNS = 20, ROWS = 10;
    const Mesh mesh = mesh_of(grid(COLUMNS, ROWS, 1, 1));
    const auto faces = faces_of(mesh);
    // A square of the grid has two faces: of one row of squares, one belongs above and one below.
    std::vector<uint32_t> cell(faces.size());
    for (uint32_t f = 0; f < cell.size(); ++f) {
        const uint32_t row = f / 2 / COLUMNS;
        cell[f] = row < 5 ? 0 : row > 5 ? 1 : f % 2;
    }
    CHECK(edges_between_cells(mesh, cell) >= 2 * COLUMNS - 1);
    straighten_borders(mesh, faces, cell);
    CHECK(edges_between_cells(mesh, cell) == COLUMNS);
}

TEST_CASE("straightened borders: fewer edges between Voronoi cells, which hang together as before") {
    for (const Soup& soup :
         {bumpy_sphere(4, 1), torus(40, 20, 2, 0.7), jittered_grid(30, 3), annulus(40, 8)}) {
        const Mesh mesh = mesh_of(soup);
        const auto faces = faces_of(mesh);
        const auto solver = ExactMetric(mesh).make_solver();
        std::vector<uint32_t> vertices = vertices_of(mesh, faces);
        Random random(5);
        const auto seeds = poisson_disk_samples(*solver, vertices, 12, random);
        const auto before = voronoi_cells(*solver, mesh, faces, seeds);
        auto cell = before;
        straighten_borders(mesh, faces, cell);
        CHECK(edges_between_cells(mesh, cell) < edges_between_cells(mesh, before));
        CHECK(connected_components(mesh, faces, cell).count <=
              connected_components(mesh, faces, before).count);
        CHECK(std::set(cell.begin(), cell.end()) == std::set(before.begin(), before.end()));
        const auto straight = cell;
        straighten_borders(mesh, faces, cell);
        CHECK(cell == straight);
    }
}

TEST_CASE("straightened borders: faces beyond the patch do not count, and a cell keeps its last face") {
    const Mesh mesh = mesh_of(grid(3, 3, 1, 1));
    const std::vector<uint32_t> one_square{8, 9}; // the one in the middle
    std::vector<uint32_t> cell{3, 4};
    straighten_borders(mesh, one_square, cell);
    CHECK(cell == std::vector<uint32_t>{3, 4});

    const auto faces = faces_of(mesh);
    std::vector<uint32_t> lone(faces.size(), 7);
    lone[9] = 2;
    auto kept = lone;
    straighten_borders(mesh, faces, kept);
    CHECK(kept == lone);
    lone[8] = 2; // of two faces one may go
    straighten_borders(mesh, faces, lone);
    CHECK(std::count(lone.begin(), lone.end(), 2u) == 1);
}
