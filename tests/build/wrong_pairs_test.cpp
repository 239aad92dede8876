// That near vertices are right, all of them, on surfaces where tables alone are not: against the metric.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/build/errors.h"
#include "tests/build/large_rough_sheet.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

namespace {

constexpr double LARGEST_ERROR = 0.01, STEEPEST = 1.05;
constexpr size_t NEAREST = 480; // vertices around each one, as geoidx.h has it

// The same index without its measured pairs, and with its steep edges left steep.
IndexHandle tables_only(const geoidx* index) {
    const Bytes tables = without_section(save(index), geodesic::TAG_MEASURED_PAIRS);
    return open(without_section(tables, geodesic::TAG_STEEP_EDGES));
}

struct Counts {
    uint64_t wrong = 0, steep = 0; // near vertices, and edges between near ones
};

// Of fields, from every step-th vertex, to those that are no nearer than so many others and no farther than
// so many.
Counts count_wrong(const geoidx* index, const TestMesh& mesh, uint32_t step, size_t nearer = 0,
                   size_t farther = NEAREST) {
    const auto edges = edges_of(mesh);
    const auto metric = solver(mesh, build_options());
    Counts counts;
    for (uint32_t source = 0; source < mesh.vertex_count(); source += step) {
        const auto exact = metric_distances(metric.get(), source, mesh.vertex_count());
        const auto field = msad(index, source, mesh.vertex_count());
        auto sorted = exact;
        std::ranges::sort(sorted);
        const double far = sorted[nearer], near = sorted[std::min(farther, sorted.size() - 1)];
        for (uint32_t v = 0; v < mesh.vertex_count(); ++v)
            if (exact[v] > far && exact[v] <= near)
                counts.wrong += std::abs(double{field[v]} / exact[v] - 1) > LARGEST_ERROR + MEASURED_ROUNDING;
        for (const auto& [a, b] : edges)
            if (exact[a] <= near && exact[b] <= near)
                counts.steep +=
                    std::abs(double{field[a]} - double{field[b]}) >
                    (STEEPEST + MEASURED_ROUNDING) * mesh.straight(a, b) + MEASURED_ROUNDING * exact[a];
    }
    return counts;
}

}

TEST_CASE("wrong pairs: no answer for near vertices is off by more than a hundredth" *
          doctest::skip(SANITIZED)) {
    for (const TestMesh& mesh : {rough_sheet(24, 4), hills(30, 20), lattice(3)}) {
        const auto index = shared_index(mesh, default_options());
        const Counts counts = count_wrong(index.get(), mesh, 1);
        CHECK(counts.wrong == 0);
    }
}

TEST_CASE("wrong pairs: a rough surface has some by its tables alone, and steep edges" *
          doctest::skip(SANITIZED)) {
    const TestMesh mesh = rough_sheet(24, 16);
    const auto index = shared_index(mesh, default_options());
    const Counts before = count_wrong(tables_only(index.get()).get(), mesh, 3),
                 now = count_wrong(index.get(), mesh, 3);
    CHECK(before.wrong > 0);
    CHECK(before.steep > 0);
    CHECK(now.wrong == 0);
    CHECK(now.steep == 0);
}

TEST_CASE("wrong pairs: around them, farther ones are found" * doctest::skip(SANITIZED)) {
    const TestMesh& mesh = large_rough_sheet();
    const auto index = open(file_of_large_rough_sheet());
    constexpr uint32_t STEP = 11;
    const Counts before = count_wrong(tables_only(index.get()).get(), mesh, STEP, NEAREST, 4 * NEAREST),
                 now = count_wrong(index.get(), mesh, STEP, NEAREST, 4 * NEAREST);
    CHECK(before.wrong > 20);
    CHECK(now.wrong < before.wrong / 4);
}

// A disk of radius 1 with a hole in its middle, and so many rings of vertices close around that.
TestMesh disk_with_tiny_hole(double hole, uint32_t rings) {
    constexpr uint32_t AROUND = 40;
    TestMesh mesh;
    for (uint32_t ring = 1; ring <= rings + 1; ++ring)
        for (uint32_t k = 0; k < AROUND; ++k) {
            const double angle = 2 * std::numbers::pi * k / AROUND, radius = ring > rings ? 1 : hole * ring;
            mesh.add_vertex(radius * std::cos(angle), radius * std::sin(angle), 0);
        }
    for (uint32_t ring = 0; ring < rings * AROUND; ring += AROUND)
        for (uint32_t k = 0; k < AROUND; ++k) {
            const uint32_t next = (k + 1) % AROUND;
            mesh.add_triangle(ring + k, ring + AROUND + k, ring + AROUND + next);
            mesh.add_triangle(ring + k, ring + AROUND + next, ring + next);
        }
    return mesh;
}

// Tables are rounded to a share of the longest distances in them.
TEST_CASE("wrong pairs: of a small mesh with tiny details, many more are held") {
    const TestMesh mesh = disk_with_tiny_hole(1e-5, 2);
    const auto index = shared_index(mesh, default_options());
    CHECK(count_wrong(tables_only(index.get()).get(), mesh, 1).wrong > 8 * mesh.vertex_count());
    CHECK(count_wrong(index.get(), mesh, 1).wrong == 0);
}

TEST_CASE("wrong pairs: where there are too many even of the worst ones, as many as may be are held") {
    constexpr uint64_t MOST = 32768;
    const TestMesh mesh = disk_with_tiny_hole(1e-6, 9);
    const auto index = shared_index(mesh, default_options());
    const Counts before = count_wrong(tables_only(index.get()).get(), mesh, 1),
                 now = count_wrong(index.get(), mesh, 1);
    CHECK(before.wrong > 2 * MOST);
    CHECK(now.wrong <= before.wrong - MOST);
}

// Most of its fields are steep along edges as short as the bevel, by the rounding of tables.
TEST_CASE("wrong pairs: on thin bevels, pairs that are only steep leave room for those that are wrong" *
          doctest::skip(SANITIZED)) {
    constexpr double NEIGHBOURS = 5; // pairs of vertices of one bevel are up to so many times its width apart
    for (const auto& [cells, bevel] : {std::pair{6u, 3e-4}, std::pair{7u, 3e-4}, std::pair{8u, 1e-4}}) {
        const TestMesh mesh = bevelled_box(cells, bevel);
        const uint32_t count = mesh.vertex_count();
        const auto index = shared_index(mesh, default_options());
        const auto metric = solver(mesh, build_options());
        CHECK(count_wrong(tables_only(index.get()).get(), mesh, 5).wrong > 0);
        double largest = 0, largest_of_pairs = 0;
        for (uint32_t source = 0; source < count; ++source) {
            const auto exact = metric_distances(metric.get(), source, count);
            const auto field = msad(index.get(), source, count);
            for (uint32_t v = 0; v < count; ++v) {
                if (v == source) continue;
                largest = std::max(largest, std::abs(double{field[v]} / exact[v] - 1));
                if (exact[v] < NEIGHBOURS * bevel)
                    largest_of_pairs = std::max(
                        largest_of_pairs, std::abs(double{sssd(index.get(), source, v)} / exact[v] - 1));
            }
        }
        CHECK(largest < LARGEST_ERROR + MEASURED_ROUNDING);
        CHECK(largest_of_pairs < LARGEST_ERROR + MEASURED_ROUNDING);
    }
}

// Paths cross borders at vertices only, so that pairs beside a border were 41 % too far apart.
TEST_CASE("wrong pairs: of weighted surfaces, hardly any near answer is off by a twentieth" *
          doctest::skip(SANITIZED)) {
    std::mt19937_64 random(4);
    for (const double most : {1.0, 10.0}) {
        const TestMesh mesh = grid(20, 20, 1);
        std::vector<double> costs(mesh.triangle_count());
        for (double& cost : costs) cost = 1 + (most - 1) * static_cast<double>(random() % 1000) / 999;
        geoidx_build_options options = default_options();
        options.metric = GEOIDX_METRIC_WEIGHTED;
        options.face_costs = costs.data();
        options.face_cost_count = costs.size();
        const auto index = shared_index(mesh, options);
        const auto metric = solver(mesh, options);
        size_t near = 0, wrong = 0;
        double largest = 0;
        for (uint32_t source = 0; source < mesh.vertex_count(); source += 4) {
            const auto exact = metric_distances(metric.get(), source, mesh.vertex_count());
            const auto field = msad(index.get(), source, mesh.vertex_count());
            auto sorted = exact;
            std::ranges::nth_element(sorted, sorted.begin() + 100);
            for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
                if (v == source || exact[v] > sorted[100]) continue;
                for (const float answer : {field[v], sssd(index.get(), source, v)}) {
                    const double error = std::abs(double{answer} / exact[v] - 1);
                    largest = std::max(largest, error);
                    wrong += error > 0.05;
                    ++near;
                }
            }
        }
        CAPTURE(most);
        CHECK(wrong <= near / 10000);
        CHECK(largest < 0.1);
        const geoidx_info info = info_of(index.get());
        CHECK(info.error_max < 0.2);
        CHECK(info.error_mean_at_vertices == info.error_mean);
    }
}
