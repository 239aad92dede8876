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

uint32_t border_rings(const Mesh& mesh, const Faces& faces) {
    std::vector<uint8_t> inside(mesh.face_count(), 0);
    for (uint32_t f : faces) inside[f] = 1;
    return count_border_rings(mesh, faces, inside);
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

TEST_CASE("border rings: a whole mesh has none, closed, open or in pieces") {
    for (const Soup& soup : {sphere(1), torus(6, 5, 2, 0.5), grid(4, 4, 1, 1), annulus(8, 2),
                             joined(grid(2, 2, 1, 1), sphere(1)), moebius(9, 2)}) {
        const Mesh mesh = mesh_of(soup);
        CHECK(border_rings(mesh, all_faces(mesh)) == 0);
    }
}

TEST_CASE("border rings: discs, rings and what is left of them on a plane") {
    const Mesh mesh = mesh_of(grid(8, 8, 1, 1));
    const auto ring_of = [](uint32_t x, uint32_t y) { return x >= 2 && x <= 4 && y >= 2 && y <= 4; };
    const auto hole = [](uint32_t x, uint32_t y) { return x == 3 && y == 3; };
    // A disc inside, a disc at the boundary, half of the mesh.
    CHECK(border_rings(mesh, cells(8, 8, ring_of)) == 1);
    CHECK(border_rings(mesh, cells(8, 8, [](uint32_t x, uint32_t y) { return x < 3 && y < 3; })) == 1);
    CHECK(border_rings(mesh, cells(8, 8, [](uint32_t x, uint32_t) { return x < 4; })) == 1);
    // A ring has two; the rest of the mesh around it has one: its outer boundary has nothing beyond.
    CHECK(border_rings(mesh, cells(8, 8, [&](auto x, auto y) { return ring_of(x, y) && !hole(x, y); })) == 2);
    CHECK(border_rings(mesh, cells(8, 8, [&](auto x, auto y) { return !ring_of(x, y); })) == 1);
    // Two holes inside.
    CHECK(border_rings(mesh, cells(8, 8, [](uint32_t x, uint32_t y) {
                           return !(y == 3 && (x == 2 || x == 5));
                       })) == 2);
    // A strip from side to side: its two borders hang together over the mesh's boundary.
    CHECK(border_rings(mesh, cells(8, 8, [](uint32_t x, uint32_t) { return x == 3; })) == 1);
    // Two discs far apart; two that touch at a corner are one chain.
    CHECK(border_rings(
              mesh, cells(8, 8, [](uint32_t x, uint32_t y) { return x == y && (x == 1 || x == 5); })) == 2);
    CHECK(border_rings(
              mesh, cells(8, 8, [](uint32_t x, uint32_t y) { return x == y && (x == 2 || x == 3); })) == 1);
}

TEST_CASE("border rings: bands around a tube, a torus and a Moebius strip") {
    const Mesh tube = mesh_of(annulus(12, 6)); // 24 faces a ring
    const auto bands = [&](uint32_t from, uint32_t to) {
        Faces faces;
        for (uint32_t f = from * 24; f < to * 24; ++f) faces.push_back(f);
        return faces;
    };
    CHECK(border_rings(tube, bands(0, 2)) == 1); // the mesh's own boundary is no border
    CHECK(border_rings(tube, bands(2, 4)) == 2);
    CHECK(border_rings(tube, bands(4, 6)) == 1);
    CHECK(border_rings(tube, bands(0, 6)) == 0);

    const Mesh ring = mesh_of(torus(10, 6, 2, 0.5)); // 12 faces a section
    Faces section(36);
    std::iota(section.begin(), section.end(), 0u);
    CHECK(border_rings(ring, section) == 2);
    CHECK(border_rings(ring, {0}) == 1);

    // A band in the middle of a Moebius strip is one, too; what is left, the rim, has one border.
    const Mesh strip = mesh_of(moebius(10, 3)); // 6 faces a section, 2 a cell
    Faces middle, rim;
    for (uint32_t f = 0; f < strip.face_count(); ++f) (f % 6 / 2 == 1 ? middle : rim).push_back(f);
    CHECK(border_rings(strip, middle) == 1);
    CHECK(border_rings(strip, rim) == 1);
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

TEST_CASE("connected components: over edges, not over vertices, apart by label") {
    const Mesh mesh = mesh_of(grid(6, 6, 1, 1));
    // Two cells that touch at a corner, and one apart.
    const Faces faces =
        cells(6, 6, [](uint32_t x, uint32_t y) { return x == y && (x == 1 || x == 2 || x == 5); });
    const std::vector<uint32_t> same(faces.size(), 7);
    const Components three = connected_components(mesh, faces, same);
    CHECK(three.count == 3);
    CHECK(three.of_face == std::vector<uint32_t>{0, 0, 1, 1, 2, 2});
    // The two faces of a cell apart by label.
    const Components apart = connected_components(mesh, faces, std::vector<uint32_t>{1, 2, 3, 3, 3, 3});
    CHECK(apart.count == 4);
    CHECK(apart.of_face == std::vector<uint32_t>{0, 1, 2, 2, 3, 3});
    // Faces outside of the span do not connect.
    const Faces row = cells(6, 6, [](uint32_t x, uint32_t y) { return y == 0 && x != 3; });
    CHECK(connected_components(mesh, row, std::vector<uint32_t>(row.size(), 0)).count == 2);
    CHECK(connected_components(mesh_of(pinched_sheets(2)), all_faces(mesh_of(pinched_sheets(2))),
                               std::vector<uint32_t>(mesh_of(pinched_sheets(2)).face_count(), 0))
              .count == 2);
}
