#include "src/mesh/halve_edges.h"

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include <Eigen/Geometry>

#include <doctest/doctest.h>

#include "tests/support/meshes.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

using Faces = std::multiset<uint32_t>; // of the mesh before

struct Case {
    Mesh before;
    std::vector<uint32_t> cut;
    HalvedEdges after;

    bool is_cut(uint32_t edge) const { return std::ranges::binary_search(cut, edge); }
    uint32_t middle(size_t i) const { return before.vertex_count() + static_cast<uint32_t>(i); }

    // The faces of the mesh before that have parts at an edge of the mesh after.
    Faces faces_at(uint32_t a, uint32_t b) const {
        const uint32_t edge = find_edge(after.mesh, a, b);
        REQUIRE(edge != NONE);
        Faces faces;
        for (const uint32_t f : after.mesh.edge_faces[edge]) faces.insert(after.whole_face[f]);
        return faces;
    }
};

// Each kind of mesh, among them ones with boundaries, with edges of three faces and with parts that touch at
// a vertex, with none, some and all of its edges cut.
std::vector<Case> cases() {
    std::mt19937_64 random(5);
    std::vector<Case> made;
    for (const Soup& soup : {grid(1, 1, 1, 1), jittered_grid(5, 3), comb(1), pinched_sheets(2), moebius(8, 2),
                             with_mixed_winding(bumpy_sphere(2, 4), 6), joined(cube(2), annulus(6, 2))})
        for (const double share : {0.0, 0.2, 0.6, 1.0}) {
            Case& test = made.emplace_back(Case{mesh_of(soup), {}, {}});
            for (uint32_t e = 0; e < test.before.edge_count(); ++e)
                if (uniform(random, 0, 1) < share) test.cut.push_back(e);
            test.after = halve_edges(test.before, test.cut);
        }
    return made;
}

// Twice the area, along the normal.
Eigen::Vector3d area_of(const Mesh& mesh, uint32_t face) {
    const auto [a, b, c] = mesh.faces[face];
    return (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
}

}

TEST_CASE("halved edges: vertices keep their numbers, and middles follow") {
    for (const Case& test : cases()) {
        REQUIRE(test.after.mesh.vertex_count() == test.before.vertex_count() + test.cut.size());
        for (uint32_t v = 0; v < test.before.vertex_count(); ++v)
            CHECK(test.after.mesh.positions[v] == test.before.positions[v]);
        for (size_t i = 0; i < test.cut.size(); ++i) {
            const auto& [a, b] = test.before.edges[test.cut[i]];
            const Eigen::Vector3d twice = 2 * test.after.mesh.positions[test.middle(i)];
            CHECK((twice - test.before.positions[a] - test.before.positions[b]).norm() < 1e-14);
        }
    }
}

// Some faces are needles, whose area is far less than the squares of their sides, which are about 1.
TEST_CASE("halved edges: parts cover their face in its plane, on the same side of it") {
    constexpr double ROUNDING = 1e-14;
    for (const Case& test : cases()) {
        REQUIRE(test.after.whole_face.size() == test.after.mesh.face_count());
        std::vector<Eigen::Vector3d> sum(test.before.face_count(), Eigen::Vector3d::Zero());
        std::vector<size_t> parts(test.before.face_count(), 0);
        for (uint32_t f = 0; f < test.after.mesh.face_count(); ++f) {
            const uint32_t whole = test.after.whole_face[f];
            const Eigen::Vector3d area = area_of(test.after.mesh, f), of_whole = area_of(test.before, whole);
            CHECK(area.dot(of_whole) > 0);
            CHECK(area.cross(of_whole).norm() < ROUNDING * of_whole.norm());
            sum[whole] += area;
            ++parts[whole];
        }
        for (uint32_t f = 0; f < test.before.face_count(); ++f) {
            CHECK((sum[f] - area_of(test.before, f)).norm() < ROUNDING);
            const auto is_cut = [&](uint32_t e) { return test.is_cut(e); };
            CHECK(parts[f] ==
                  1 + static_cast<size_t>(std::ranges::count_if(test.before.face_edges[f], is_cut)));
        }
    }
}

TEST_CASE("halved edges: all faces at an edge are at both of its halves, and others are whole") {
    for (const Case& test : cases()) {
        size_t known = 0, middles = 0;
        for (uint32_t e = 0; e < test.before.edge_count(); ++e) {
            const auto& [a, b] = test.before.edges[e];
            const auto faces = test.before.edge_faces[e];
            const Faces expected(faces.begin(), faces.end());
            if (!test.is_cut(e)) {
                CHECK(test.faces_at(a, b) == expected);
                ++known;
                continue;
            }
            const uint32_t middle = test.middle(middles++);
            CHECK(find_edge(test.after.mesh, a, b) == NONE);
            CHECK(test.faces_at(a, middle) == expected);
            CHECK(test.faces_at(middle, b) == expected);
            known += 2;
        }
        // The others part two parts of one face.
        size_t inside = 0;
        for (uint32_t e = 0; e < test.after.mesh.edge_count(); ++e) {
            const auto faces = test.after.mesh.edge_faces[e];
            const bool is_inside =
                faces.size() == 2 && test.after.whole_face[faces[0]] == test.after.whole_face[faces[1]];
            inside += is_inside ? 1 : 0;
        }
        CHECK(known + inside == test.after.mesh.edge_count());
    }
}
