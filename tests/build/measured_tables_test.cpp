// Tables of a mesh with added vertices, filled with what was measured on the mesh without them.
#include "src/tables/measured_tables.h"

#include <cstdlib>
#include <numeric>

#include <doctest/doctest.h>

#include "src/build/finer_borders.h"
#include "src/metric/window_propagation.h"
#include "src/tables/borders.h"
#include "src/tables/layout.h"
#include "src/tables/overlay_fill.h"
#include "src/tables/pruning.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"
#include "tests/support/surfaces.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// A mesh with a hierarchy of two levels.
struct Coarse {
    Mesh mesh;
    Hierarchy hierarchy;

    explicit Coarse(const Soup& soup) : mesh(mesh_of(soup)) {
        const ExactMetric metric(mesh);
        Workers workers(metric, 2, {});
        hierarchy = build_hierarchy(mesh, {{3, 4}}, workers);
    }
};

// The same surface with some of its border edges cut in halves.
FinerSurface cut(const Mesh& mesh, const Hierarchy& hierarchy, double share) {
    const ExactMetric metric(mesh);
    Workers workers(metric, 2, {});
    const uint32_t sources[] = {0, 5};
    const auto edges =
        border_edges(mesh, hierarchy.leaf_of_face, sources, ShortDistances(components_of(mesh)), workers);
    const auto count = static_cast<size_t>(share * static_cast<double>(edges.size()));
    REQUIRE(count > 0);
    return with_finer_borders(mesh, hierarchy, std::span(edges).first(count));
}

// Distances are rounded to codes of 16 bits, and no further. Patches of more than EXACT_VERTICES are put
// together from their children.
StoredIndex filled(const Mesh& mesh, const Hierarchy& hierarchy, std::optional<MeasuredTables>* measured) {
    constexpr uint32_t EXACT_VERTICES = 60;
    const ExactMetric metric(mesh);
    Workers workers(metric, 2, {});
    StoredIndex stored;
    const auto leaves = leaves_at_vertices(mesh, hierarchy);
    std::vector<uint32_t> vertex_of_id(mesh.vertex_count());
    std::iota(vertex_of_id.begin(), vertex_of_id.end(), 0u);
    const auto vertex_of_number = lay_out(mesh, vertex_of_id, hierarchy, leaves,
                                          merge_border_vertices(mesh, leaves, 0, workers), workers, stored);
    fill_overlay_tables(mesh, hierarchy.leaf_of_face, vertex_of_number, {EXACT_VERTICES, 0, true, 1}, workers,
                        stored, nullptr, measured);
    return stored;
}

// By at most one step: distances on two meshes differ by rounding.
void check_same_codes(std::span<const uint16_t> codes, std::span<const uint16_t> expected) {
    REQUIRE(codes.size() == expected.size());
    for (size_t i = 0; i < codes.size(); ++i) CHECK(std::abs(codes[i] - expected[i]) <= 1);
}

void check_same(const StoredIndex& stored, const StoredIndex& expected) {
    REQUIRE(stored.quantum.size() == expected.quantum.size());
    for (size_t p = 0; p < stored.quantum.size(); ++p)
        CHECK(stored.quantum[p] == doctest::Approx(expected.quantum[p]).epsilon(1e-6));
    CHECK(stored.border == expected.border);
    check_same_codes(stored.overlay_codes, expected.overlay_codes);
    check_same_codes(stored.border_internal_codes, expected.border_internal_codes);
    check_same_codes(stored.internal_codes, expected.internal_codes);
}

}

TEST_CASE("measured tables: round by round, the same tables as if all were measured") {
    for (const Soup& soup : {bumpy_sphere(3, 2), joined(cube(4), moebius(14, 3)), comb(4), pinched_sheets(6),
                             annulus(24, 6), closed_cylinder(40, 2)}) {
        const Coarse coarse(soup);
        std::optional<MeasuredTables> measured;
        check_same(filled(coarse.mesh, coarse.hierarchy, &measured),
                   filled(coarse.mesh, coarse.hierarchy, nullptr));
        REQUIRE(measured);
        CHECK(measured->vertex_count() == coarse.mesh.vertex_count());
        const FinerSurface finer = cut(coarse.mesh, coarse.hierarchy, 0.5);
        check_same(filled(finer.mesh, finer.hierarchy, &measured),
                   filled(finer.mesh, finer.hierarchy, nullptr));
        const FinerSurface finest = cut(finer.mesh, finer.hierarchy, 0.3);
        check_same(filled(finest.mesh, finest.hierarchy, &measured),
                   filled(finest.mesh, finest.hierarchy, nullptr));
        CHECK(measured->vertex_count() == finest.mesh.vertex_count());
    }
}

// What is known shows, since it is changed: all known distances are three times as long.
TEST_CASE("measured tables: pairs of known vertices are taken, and pairs with an added one measured" *
          doctest::skip(SANITIZED)) {
    const Coarse coarse(bumpy_sphere(3, 4));
    std::optional<MeasuredTables> measured;
    filled(coarse.mesh, coarse.hierarchy, &measured);
    auto& tables = measured->tables;
    for (auto* table : {&tables.border_internal, &tables.internal})
        for (float& distance : *table) distance *= 3;
    for (auto& table : tables.overlay)
        for (float& distance : table) distance *= 3;
    const FinerSurface finer = cut(coarse.mesh, coarse.hierarchy, 0.5);
    const auto solver = ExactMetric(finer.mesh).make_solver();
    filled(finer.mesh, finer.hierarchy, &measured);
    const Numbering& numbering = measured->numbering;
    std::vector<uint32_t> vertex_of_number(finer.mesh.vertex_count());
    for (uint32_t v = 0; v < finer.mesh.vertex_count(); ++v)
        vertex_of_number[measured->number_of_vertex[v]] = v;
    size_t known = 0, added = 0;
    const auto check = [&](uint32_t a, uint32_t b, float distance) {
        const uint32_t from = vertex_of_number[a], to = vertex_of_number[b];
        solver->solve({&from, 1}, {&to, 1});
        const bool are_known = std::max(from, to) < coarse.mesh.vertex_count();
        (are_known ? known : added) += 1;
        CHECK(double{distance} == doctest::Approx((are_known ? 3 : 1) * solver->distance(to)).epsilon(1e-5));
    };
    for (uint32_t p = 0; p < numbering.first_leaf(); ++p) {
        const uint32_t size = numbering.overlay_size(p);
        if (tables.overlay[p].empty()) continue;
        for (uint32_t i = 0; i < size; i += 3)
            for (uint32_t j = 0; j < size; j += 2)
                check(numbering.overlay_number(p, i), numbering.overlay_number(p, j),
                      tables.overlay[p][size_t{i} * size + j]);
    }
    for (uint32_t leaf = numbering.first_leaf(); leaf < numbering.patch_count(); ++leaf) {
        const auto border = numbering.border_of(leaf);
        const uint32_t first = numbering.first_internal(leaf);
        for (uint32_t i = 0; i < numbering.internal_size(leaf); ++i) {
            for (uint32_t k = 0; k < border.size(); k += 2)
                check(border[k], first + i,
                      tables.border_internal[numbering.border_internal_entry(leaf, k, i)]);
            for (uint32_t j = 0; j < i; ++j)
                check(first + i, first + j, tables.internal[numbering.internal_entry(leaf, i, j)]);
        }
    }
    CHECK(known > 500);
    CHECK(added > 500);
}
