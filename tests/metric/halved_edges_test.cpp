// Cutting edges in halves changes no distance of the exact metric.
#include <random>

#include <doctest/doctest.h>

#include "src/mesh/halve_edges.h"
#include "src/metric/window_propagation.h"
#include "tests/support/meshes.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// Twice, so that halves are cut, too.
Mesh with_edges_cut(Mesh mesh, double share, uint64_t seed) {
    std::mt19937_64 random(seed);
    for (int round = 0; round < 2; ++round) {
        std::vector<uint32_t> cut;
        for (uint32_t e = 0; e < mesh.edge_count(); ++e)
            if (uniform(random, 0, 1) < share) cut.push_back(e);
        mesh = halve_edges(mesh, cut).mesh;
    }
    return mesh;
}

}

TEST_CASE("halved edges: exact distances are the same") {
    for (const Soup& soup : {delaunay_square(80, 3), sphere(2), torus(9, 6, 2, 0.8), comb(2), moebius(9, 2),
                             pinched_sheets(2), cone(saddle_rays(8, 0.7), 3)})
        for (const double share : {0.15, 0.7}) {
            const Mesh whole = mesh_of(soup), cut = with_edges_cut(whole, share, 11);
            REQUIRE(cut.vertex_count() > whole.vertex_count());
            const auto on_whole = ExactMetric(whole).make_solver(), on_cut = ExactMetric(cut).make_solver();
            for (uint32_t source = 0; source < whole.vertex_count(); source += 7) {
                on_whole->solve({&source, 1}, {});
                on_cut->solve({&source, 1}, {});
                for (uint32_t v = 0; v < whole.vertex_count(); ++v)
                    CHECK(on_cut->distance(v) == doctest::Approx(on_whole->distance(v)).epsilon(1e-12));
            }
        }
}
