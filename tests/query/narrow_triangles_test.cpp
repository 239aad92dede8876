// Pairs and fields of the overlay engine where triangles are long and narrow, and samples of borders tell
// little.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/query/query_cases.h"
#include "tests/support/edge_lengths.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

namespace {

// A rough grid of vertices, 0.05 apart along x and 2 along y, whose diagonals alternate.
TestMesh narrow_triangles(uint32_t columns, uint32_t rows) {
    TestMesh mesh = grid(columns, rows);
    std::mt19937 random(5);
    for (size_t i = 0; i < mesh.positions.size(); i += 3) {
        mesh.positions[i] *= 0.05;
        mesh.positions[i + 1] *= 2;
        mesh.positions[i + 2] = 0.02 * static_cast<double>(random()) / 4294967296.0;
    }
    mesh.triangles.clear();
    for (uint32_t y = 0; y + 1 < rows; ++y)
        for (uint32_t x = 0; x + 1 < columns; ++x) {
            const uint32_t a = y * columns + x, b = a + 1, c = a + columns, d = c + 1;
            const bool rises = (x + y) % 2 == 0;
            mesh.add_triangle(a, b, rises ? d : c);
            mesh.add_triangle(rises ? a : b, d, c);
        }
    return mesh;
}

}

// Borders that run in teeth from one side of such triangles to the other have samples far apart where the
// surface is narrow, and fields that jump beside them.
TEST_CASE("overlay: pairs and fields on triangles 40 times as long as wide" * doctest::skip(SANITIZED)) {
    const TestMesh mesh = narrow_triangles(150, 18);
    const uint32_t count = mesh.vertex_count();
    geoidx_build_options options;
    geoidx_build_options_init(&options);
    const auto built = shared_index(mesh, options);
    const auto opened = without_labels(built.get());
    const auto exact = solver(mesh, options);
    Differences fields, pairs, pairs_without_labels;
    for (uint32_t source = 0; source < count; source += 67) {
        const auto expected = metric_distances(exact.get(), source, count);
        const auto field = msad(built.get(), source, count);
        for (uint32_t target = 0; target < count; ++target) {
            fields.add(double{field[target]}, expected[target]);
            pairs.add(double{sssd(built.get(), source, target)}, expected[target]);
            pairs_without_labels.add(double{sssd(opened.get(), source, target)}, expected[target]);
        }
    }
    for (const Differences& differences : {fields, pairs, pairs_without_labels}) {
        CHECK(differences.reached_wrongly == 0);
        CHECK(differences.mean() < 5e-4);
    }
    CHECK(fields.largest < 0.03);
    CHECK(pairs.largest < 0.03);
    CHECK(pairs_without_labels.largest < 0.08); // ways over samples lose more, as docs/limits.md says
}

// Where triangles are long and narrow, borders zigzag so much that their samples tell little. The edges have
// lengths of their own, so that none is flipped.
TEST_CASE("overlay: SSSD on a stretched plane" * doctest::skip(SANITIZED)) {
    TestMesh mesh = grid(50, 50, 0.2);
    for (size_t i = 0; i < mesh.positions.size(); i += 3) mesh.positions[i] *= 8;
    const uint32_t count = mesh.vertex_count();
    const std::vector<double> lengths = edge_lengths_of(mesh);
    auto options = overlay_options(GEOIDX_METRIC_EXACT, 0, 400);
    options.edge_lengths = lengths.data();
    options.edge_length_count = lengths.size();
    const auto index = shared_index(mesh, options);
    const QueryHandle query = query_of(index.get());
    Differences errors;
    for (uint32_t source = 0; source < count; source += 7)
        for (uint32_t target = 0; target < count; ++target) {
            float distance = 0;
            require_success(geoidx_query_sssd(query.get(), source, target, &distance));
            errors.add(double{distance}, mesh.straight(source, target));
        }
    CHECK(errors.reached_wrongly == 0);
    CHECK(errors.mean() < 1e-4);
    CHECK(errors.largest < 0.05);
}

// Rings are 64 times as far apart as their vertices. So the border of one patch zigzags between two rings and
// has samples that are far apart, while that of the patch around it follows a ring and has near ones.
TEST_CASE("overlay: SSSD on a tube of long and narrow triangles" * doctest::skip(SANITIZED)) {
    constexpr uint32_t RINGS = 21, AROUND = 200;
    constexpr double RADIUS = 10, APART = 20;
    const double side = 2 * RADIUS * std::sin(std::numbers::pi / AROUND);
    TestMesh mesh;
    for (uint32_t v = 0; v < RINGS * AROUND; ++v) {
        const double angle = 2 * std::numbers::pi * (v % AROUND) / AROUND;
        mesh.positions.insert(mesh.positions.end(),
                              {RADIUS * std::cos(angle), RADIUS * std::sin(angle), APART * (v / AROUND)});
    }
    for (uint32_t v = 0; v < (RINGS - 1) * AROUND; ++v) {
        const uint32_t next = v / AROUND * AROUND + (v + 1) % AROUND;
        const std::array<uint32_t, 6> corners{v, next, v + AROUND, next, next + AROUND, v + AROUND};
        mesh.triangles.insert(mesh.triangles.end(), corners.begin(), corners.end());
    }
    // With these no edge is flipped, and nothing measured beside the tables.
    const std::vector<double> lengths = edge_lengths_of(mesh);
    auto options = overlay_options(GEOIDX_METRIC_EXACT, 0, 400);
    options.edge_lengths = lengths.data();
    options.edge_length_count = lengths.size();
    const auto index = shared_index(mesh, options);
    Differences errors;
    uint64_t longer_than_in_field = 0;
    for (uint32_t source = 0; source < mesh.vertex_count(); source += 41) {
        const auto field = msad(index.get(), source, mesh.vertex_count());
        for (uint32_t target = 0; target < mesh.vertex_count(); ++target) {
            const double distance = double{sssd(index.get(), source, target)};
            const int turn = std::abs(static_cast<int>(source % AROUND) - static_cast<int>(target % AROUND));
            const int rise = static_cast<int>(source / AROUND) - static_cast<int>(target / AROUND);
            errors.add(distance,
                       std::hypot(side * std::min(turn, static_cast<int>(AROUND) - turn), APART * rise));
            longer_than_in_field += distance > 1.01 * double{field[target]};
        }
    }
    CHECK(errors.reached_wrongly == 0);
    CHECK(errors.mean() < 1e-4);
    CHECK(longer_than_in_field == 0);
}

// Segments here are longer than samples are apart, and borders have several hundred places, so that ways over
// samples do not tell which one is the shortest.
TEST_CASE("overlay: near pairs on an uneven stretched plane are as far apart as in a field" *
          doctest::skip(SANITIZED)) {
    TestMesh mesh = grid(400, 40);
    std::mt19937 random(3);
    for (size_t i = 0; i < mesh.positions.size(); i += 3)
        for (const auto& [axis, factor] : {std::pair{0u, 1.0}, std::pair{1u, 40.0}}) {
            const double aside = static_cast<double>(random() % 1000) / 1000 - 0.5;
            mesh.positions[i + axis] = factor * (mesh.positions[i + axis] + 0.9 * aside);
        }
    const uint32_t count = mesh.vertex_count();
    auto options = options_of_plane(mesh, {3, 4, 3});
    options.engine = GEOIDX_ENGINE_OVERLAY;
    const auto index = build(mesh, options);
    const QueryHandle query = query_of(index.get());
    uint64_t pairs = 0, longer = 0;
    for (uint32_t source = 5; source < count; source += 400) {
        const auto field = msad(index.get(), source, count);
        for (uint32_t target = 0; target < count; ++target) {
            float distance = 0;
            require_success(geoidx_query_sssd(query.get(), source, target, &distance));
            longer += distance > 1.02f * field[target];
            ++pairs;
        }
    }
    CHECK(longer < pairs / 5000);
}
