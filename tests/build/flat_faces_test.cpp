// How planes are cut into triangles changes no distance, so that it must not change how exact answers are.
#include <algorithm>
#include <cmath>

#include "tests/capi/calls.h"
#include "tests/support/drilled_plate.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

namespace {

// Distances of the metric, and those of an index with default options, by fields and by pairs.
struct Errors {
    double mean = 0, max = 0, pair_max = 0;
};

TestMesh test_mesh_of(const Soup& soup) {
    TestMesh mesh;
    for (const auto& p : soup.positions) mesh.add_vertex(p.x(), p.y(), p.z());
    for (const auto& [a, b, c] : soup.triangles) mesh.add_triangle(a, b, c);
    return mesh;
}

Errors errors_of(const TestMesh& mesh) {
    const auto index = build(mesh, default_options());
    const auto metric = solver(mesh, default_options());
    const uint32_t count = mesh.vertex_count();
    Errors errors;
    double pairs = 0;
    for (uint32_t source = 1; source < count; source += 37) {
        const auto exact = metric_distances(metric.get(), source, count);
        const auto field = msad(index.get(), source, count);
        for (uint32_t v = 0; v < count; ++v) {
            if (v == source) continue;
            const double error = std::abs(double{field[v]} - exact[v]) / exact[v];
            const double pair_error = std::abs(double{sssd(index.get(), source, v)} - exact[v]) / exact[v];
            errors.mean += error;
            errors.max = std::max(errors.max, error);
            errors.pair_max = std::max(errors.pair_max, pair_error);
            ++pairs;
        }
    }
    errors.mean /= pairs;
    return errors;
}

}

TEST_CASE("flat faces: a plate that is cut into slivers is answered nearly as exactly as any") {
    const Errors errors = errors_of(test_mesh_of(drilled_plate(smaller(4, 3), 20, 0.02)));
    INFO("mean ", errors.mean, ", max ", errors.max, ", of pairs ", errors.pair_max);
    CHECK(errors.mean < 0.001);
    CHECK(errors.max < 0.03);
    CHECK(errors.pair_max < 0.03);
}
