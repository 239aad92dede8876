// Distances that are too short to have a relative error, as at a pole whose vertices are 1e-16 apart, decide
// nothing and are not stated; those that are short beside the edges of the mesh still are.
#include <algorithm>
#include <cmath>

#include "src/file/sections.h"
#include "tests/build/errors.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

namespace {

constexpr uint32_t RINGS = 16, AROUND = 32;
constexpr double SINE_OF_PI = 1.2246467991473532e-16;

// Not the same from all sides, so that there are errors.
TestMesh lumpy(double last_radius) {
    TestMesh mesh = textbook_sphere(RINGS, AROUND, 1.5, last_radius);
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        double* const at = mesh.positions.data() + 3 * v;
        const double factor = 1 + 0.05 * std::sin(9 * at[0]) * std::cos(7 * at[1]);
        for (size_t k = 0; k < 3; ++k) at[k] *= factor;
    }
    return mesh;
}

}

TEST_CASE("short distances: a pole of twins decides nothing and is not stated" * doctest::skip(SANITIZED)) {
    const TestMesh mesh = lumpy(SINE_OF_PI);
    auto welding = default_options();
    welding.weld_tolerance = 1e-9;
    const auto index = shared_index(mesh, default_options());
    const geoidx_info info = info_of(index.get()), welded = info_of(build(mesh, welding).get());
    REQUIRE(info.welded_vertex_count == welded.welded_vertex_count + AROUND - 1);
    const Errors errors = errors_of(index.get(), mesh, build_options(), {.shortest = 1e-6});
    CHECK(errors.max < 0.011);
    CHECK(info.error_mean == doctest::Approx(errors.mean).epsilon(0.3));
    CHECK(info.error_max < 2 * std::max(errors.max, errors.pair_max));
    CHECK(info.error_several_max < 0.02);
    CHECK(info.error_mean <= default_options().target_error);
    CHECK(info.error_mean_at_vertices < 2 * welded.error_mean_at_vertices);
    CHECK(info.added_vertex_count < 2 * std::max<uint64_t>(welded.added_vertex_count, 50));
    CHECK(info.table_entries < 1.5 * double(welded.table_entries));
}

TEST_CASE("short distances: fields do not tell twins from each other") {
    const TestMesh mesh = lumpy(SINE_OF_PI);
    const uint32_t count = mesh.vertex_count(), twins = RINGS * AROUND;
    const auto index = shared_index(mesh, default_options());
    for (uint32_t source = 0; source < count; source += sparse(3)) {
        const auto field = msad(index.get(), source, count);
        const auto [least, most] = std::minmax_element(field.begin() + twins, field.end());
        CHECK(*most - *least <= 1e-6 * *least + 1e-15);
    }
}

TEST_CASE("short distances: by other metrics they are short beside the longest one") {
    const TestMesh mesh = textbook_sphere(8, 12, 1.5, SINE_OF_PI);
    const std::vector<double> costs(mesh.triangle_count(), 3);
    auto weighted = default_options(), along_edges = default_options();
    weighted.metric = GEOIDX_METRIC_WEIGHTED;
    weighted.face_costs = costs.data();
    weighted.face_cost_count = costs.size();
    along_edges.metric = GEOIDX_METRIC_EDGES;
    for (const auto& options : {weighted, along_edges}) {
        CAPTURE(options.metric);
        const geoidx_info info = info_of(build(mesh, options).get());
        CHECK(info.error_mean < 0.01);
        CHECK(info.error_max < 1);
        CHECK(info.error_several_max < 1);
        CHECK(info.error_mean_at_vertices < 0.05);
    }
}

TEST_CASE("short distances: those of edges 1e-4 times as long as others are compared, held and stated" *
          doctest::skip(SANITIZED)) {
    const double edge = average_edge(lumpy(SINE_OF_PI)), radius = 1e-4 * edge;
    const TestMesh mesh = lumpy(radius);
    const auto index = shared_index(mesh, default_options());
    const Asked short_ones{.shortest = 1e-7, .longest = 0.1 * edge};
    const Errors errors = errors_of(index.get(), mesh, build_options(), short_ones);
    CHECK(errors.max < 0.01 + MEASURED_ROUNDING);
    CHECK(errors.pair_max < 0.01 + MEASURED_ROUNDING);

    auto along_edges = default_options(); // which holds no pairs: tables round such distances to nothing
    along_edges.metric = GEOIDX_METRIC_EDGES;
    const auto rounded = shared_index(mesh, along_edges);
    const Errors of_rounded = errors_of(rounded.get(), mesh, along_edges, short_ones);
    CHECK(of_rounded.max > 0.5);
    CHECK(info_of(rounded.get()).error_near_max > 0.5 * of_rounded.max);
}

TEST_CASE("short distances: a part that is wide and far away makes none of another part short") {
    const TestMesh alone = lumpy(0.1);
    TestMesh mesh = alone;
    const uint32_t first = mesh.vertex_count();
    mesh.positions.insert(mesh.positions.end(), {1e8, 0, 0, 1e8 + 1e7, 0, 0, 1e8, 1e7, 0});
    mesh.triangles.insert(mesh.triangles.end(), {first, first + 1, first + 2});
    const geoidx_info of_part = info_of(shared_index(alone, default_options()).get());
    const geoidx_info info = info_of(build(mesh, default_options()).get());
    REQUIRE(of_part.added_vertex_count > 0);
    CHECK(info.added_vertex_count > of_part.added_vertex_count / 3);
    CHECK(info.error_mean > of_part.error_mean / 2);
    CHECK(info.error_mean < 2 * of_part.error_mean);
    CHECK(info.error_max > of_part.error_max / 4);
}
