// Exact distances against a graph that converges to them from above.
#include <algorithm>
#include <string>

#include <doctest/doctest.h>

#include "src/metric/window_propagation.h"
#include "tests/support/meshes.h"
#include "tests/support/oracles.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

struct Gap {
    double below = 0; // how far the exact distance is above the bound, which must not be
    double above = 0; // how far the bound is above
    double mean = 0;
};

Gap gap_to_steiner(const Mesh& mesh, const std::vector<double>& exact, uint32_t source, uint32_t points) {
    const auto bound = steiner_distances(mesh, source, points);
    Gap gap;
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        if (exact[v] == bound[v]) continue;
        const double relative = bound[v] / exact[v] - 1;
        gap.below = std::max(gap.below, -relative);
        gap.above = std::max(gap.above, relative);
        gap.mean += relative / mesh.vertex_count();
    }
    return gap;
}

void check_between(const std::string& name, const Soup& soup, uint64_t seed) {
    CAPTURE(name);
    const Mesh mesh = mesh_of(soup);
    std::mt19937_64 random(seed);
    for (int i = 0; i < 2; ++i) {
        const auto source = static_cast<uint32_t>(random() % mesh.vertex_count());
        CAPTURE(source);
        const auto exact = exact_field(mesh, source);
        const Gap coarse = gap_to_steiner(mesh, exact, source, 10);
        const Gap fine = gap_to_steiner(mesh, exact, source, 40);
        CHECK(coarse.below < 1e-12);
        CHECK(fine.below < 1e-12);
        // A crossing is at most half of 1/41 of an edge off. That costs its square across a good triangle,
        // but its first power across a needle, and a path near its source may cross nothing else.
        CHECK(fine.above < 0.03);
        CHECK(fine.mean < 2e-3);
        // It converges to our distances and to nothing else: at 11/41 or better.
        CHECK(fine.mean < 0.35 * coarse.mean);
        CHECK(fine.above < 0.5 * coarse.above);
    }
}

}

TEST_CASE("exact and Steiner points: closed surfaces" * doctest::skip(SANITIZED)) {
    check_between("torus", torus(20, 10, 2, 0.8), 1);
    check_between("thin torus", torus(30, 6, 3, 0.2), 2);
    for (uint64_t seed = 1; seed <= 3; ++seed) check_between("bumpy sphere", bumpy_sphere(2, seed), seed);
    check_between("bumpy sphere, finer", bumpy_sphere(3, 4), 4);
}

TEST_CASE("exact and Steiner points: boundaries, saddles and pinches") {
    check_between("annulus", annulus(16, 4), 1);
    check_between("saddle", cone(saddle_rays(10, 0.9), 5), 2);
    check_between("L", l_shape(5), 3);
    check_between("sheets", pinched_sheets(3), 4);
    check_between("edges of three faces", comb(1), 5);
}

TEST_CASE("exact and Steiner points: one-sided and mixed winding") {
    check_between("Moebius strip", moebius(24, 4), 1);
    check_between("Moebius strip, mixed", with_mixed_winding(moebius(24, 4), 9), 2);
    check_between("sphere, mixed", with_mixed_winding(bumpy_sphere(2, 7), 8), 3);
}
