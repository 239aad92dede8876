#include "src/partition/patch.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <set>

#include <doctest/doctest.h>

#include "tests/support/meshes.h"
#include "tests/support/oracles.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

using Faces = std::vector<uint32_t>;

Faces all_faces(const Mesh& mesh) {
    Faces faces(mesh.face_count());
    std::iota(faces.begin(), faces.end(), 0u);
    return faces;
}

// The faces of cells of a grid: cell x + y * columns has two.
Faces cells(uint32_t columns, uint32_t rows, const std::function<bool(uint32_t, uint32_t)>& wanted) {
    Faces faces;
    for (uint32_t y = 0; y < rows; ++y)
        for (uint32_t x = 0; x < columns; ++x)
            if (wanted(x, y))
                for (uint32_t k : {0u, 1u}) faces.push_back(2 * (x + y * columns) + k);
    return faces;
}

}

TEST_CASE("vertices_of: ascending, each once") {
    const Mesh mesh = mesh_of(shuffled(bumpy_sphere(2, 1), 3, *std::make_unique<std::vector<uint32_t>>()));
    Faces faces;
    for (uint32_t f = 5; f < mesh.face_count(); f += 3) faces.push_back(f);
    std::set<uint32_t> expected;
    for (uint32_t f : faces) expected.insert(mesh.faces[f].begin(), mesh.faces[f].end());
    CHECK(vertices_of(mesh, faces) == std::vector(expected.begin(), expected.end()));
    CHECK(vertices_of(mesh, {}).empty());
}

TEST_CASE("connected groups: over edges, not over vertices, apart by label") {
    const Mesh mesh = mesh_of(grid(6, 6, 1, 1));
    // Two cells that touch at a corner, and one apart.
    const Faces faces =
        cells(6, 6, [](uint32_t x, uint32_t y) { return x == y && (x == 1 || x == 2 || x == 5); });
    const std::vector<uint32_t> same(faces.size(), 7);
    const FaceGroups three = connected_groups(mesh, faces, same);
    CHECK(three.count == 3);
    CHECK(three.of_face == std::vector<uint32_t>{0, 0, 1, 1, 2, 2});
    // The two faces of a cell apart by label.
    const FaceGroups apart = connected_groups(mesh, faces, std::vector<uint32_t>{1, 2, 3, 3, 3, 3});
    CHECK(apart.count == 4);
    CHECK(apart.of_face == std::vector<uint32_t>{0, 1, 2, 2, 3, 3});
    // Faces outside of the span do not connect.
    const Faces row = cells(6, 6, [](uint32_t x, uint32_t y) { return y == 0 && x != 3; });
    CHECK(connected_groups(mesh, row, std::vector<uint32_t>(row.size(), 0)).count == 2);
    CHECK(connected_groups(mesh_of(pinched_sheets(2)), all_faces(mesh_of(pinched_sheets(2))),
                           std::vector<uint32_t>(mesh_of(pinched_sheets(2)).face_count(), 0))
              .count == 2);
}
