// Paths between points, compared with the exact metric.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tests/capi/refusals.h"
#include "tests/path/path_checks.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

namespace {

void check_paths(const PathCase& on, size_t count) {
    std::mt19937_64 random(3);
    size_t paths = 0, shortest = 0;
    for (size_t i = 0; i < count; ++i) {
        const auto from = random_point(on.soup, random, i), to = random_point(on.soup, random, i / 4);
        const double exact = on.exact(from, to);
        if (exact == INFINITE) {
            double length = 0;
            check_refused(geoidx_query_path(on.query.get(), on.surface.get(), &from, &to,
                                            GEOIDX_PATH_STRAIGHT, &length),
                          GEOIDX_ERROR_NO_PATH, "component");
            uint64_t left = 1;
            CHECK(geoidx_query_path_points(on.query.get(), nullptr, 0, &left) == GEOIDX_OK);
            CHECK(left == 0);
            continue;
        }
        ++paths;
        CAPTURE(i);
        CAPTURE(exact);
        const double straight = path_length(on, from, to, GEOIDX_PATH_STRAIGHT);
        CHECK(straight >= exact * (1 - 1e-9) - 1e-9);
        if (straight <= exact * (1 + 1e-6) + 1e-9) ++shortest;
        const double best = path_length(on, from, to, GEOIDX_PATH_EXACT);
        CHECK(std::abs(best - exact) <= exact * 1e-7 + 1e-9);
    }
    CHECK(shortest * 2 >= paths);
}

}

TEST_CASE("path: on triangles, never shorter than the exact distance, and exact when asked") {
    size_t number = 0;
    for (const Soup& soup : path_soups()) {
        ++number;
        CAPTURE(number);
        check_paths(PathCase(soup), 40);
    }
}

// Where hundreds of faces meet, ways turn around the vertex, end there, and cross two faces beside it. Three
// more faces stand on edges of the second one.
TEST_CASE("path: around a vertex of hundreds of faces") {
    Soup finned = cone(saddle_rays(120, 0.2), 1);
    for (const uint32_t ray : {1u, 2u, 40u}) {
        finned.positions.push_back(finned.positions[ray] + Eigen::Vector3d(0, 0, 1));
        finned.triangles.push_back({0, ray, finned.vertex_count() - 1});
    }
    for (const Soup& soup : {cone(saddle_rays(300, 0.05), 1), finned}) {
        const PathCase on(soup);
        check_paths(on, 40);
        std::mt19937_64 random(9);
        const auto apex = on.at_vertex(0);
        for (size_t i = 0; i < 10; ++i) {
            const auto to = random_point(soup, random, i);
            const double line = (on.position(to) - soup.positions[0]).norm();
            for (const uint32_t quality : {GEOIDX_PATH_STRAIGHT, GEOIDX_PATH_EXACT}) {
                CHECK(path_length(on, apex, to, quality) == doctest::Approx(line).epsilon(1e-12));
                CHECK(path_length(on, to, apex, quality) == doctest::Approx(line).epsilon(1e-12));
            }
        }
    }
}

// Faces of such soups share edges with any number of others, only a vertex, or nothing: ways lead over
// vertices where no edge has a face beyond.
TEST_CASE("path: on random triangles between a few points, in both directions" * doctest::skip(SANITIZED)) {
    for (uint64_t seed = 0; seed < 60; ++seed) {
        CAPTURE(seed);
        std::mt19937_64 random(seed);
        const PathCase on(random_soup(random, 7 + seed % 6, 4 + seed % 9));
        for (size_t i = 0; i < 6; ++i) {
            CAPTURE(i);
            const auto from = random_point(on.soup, random, i), to = random_point(on.soup, random, i / 2);
            const double exact = on.exact(from, to);
            double length = 0;
            if (exact == INFINITE) {
                CHECK(geoidx_query_path(on.query.get(), on.surface.get(), &from, &to, GEOIDX_PATH_EXACT,
                                        &length) == GEOIDX_ERROR_NO_PATH);
                continue;
            }
            for (const uint32_t quality : {GEOIDX_PATH_STRAIGHT, GEOIDX_PATH_EXACT}) {
                CHECK(path_length(on, from, to, quality) >= exact * (1 - 1e-7) - 1e-9);
                CHECK(path_length(on, to, from, quality) >= exact * (1 - 1e-7) - 1e-9);
            }
        }
    }
}

TEST_CASE("path: by the graph engine, too") {
    check_paths(PathCase(joined(torus(12, 8, 1, 0.4), comb(1)), path_options(GEOIDX_ENGINE_GRAPH)), 24);
}

// Between peaks many ways are nearly as short, and the index errs by percents. Those that are locally
// shortest are 1.8 % too long on average.
TEST_CASE("path: exact on spikes, and straight nearly so" * doctest::skip(SANITIZED)) {
    std::mt19937_64 random(17);
    constexpr uint32_t CELLS = 36;
    Soup soup = grid(CELLS, CELLS, CELLS, CELLS);
    for (auto& position : soup.positions) position.z() = uniform(random, 0, 20);
    const PathCase on(std::move(soup));
    constexpr size_t COUNT = 250;
    double too_long = 0;
    for (size_t i = 0; i < COUNT; ++i) {
        CAPTURE(i);
        const auto from = random_point(on.soup, random, i), to = random_point(on.soup, random, i / 4);
        const double exact = on.exact(from, to), best = path_length(on, from, to, GEOIDX_PATH_EXACT);
        CHECK(std::abs(best - exact) <= exact * 1e-7);
        const double straight = path_length(on, from, to, GEOIDX_PATH_STRAIGHT) - exact;
        CHECK(straight <= exact * 0.05);
        if (exact > 0) too_long += straight / exact;
    }
    CHECK(too_long / COUNT < 0.003);
}

TEST_CASE("path: on stress meshes") {
    for_each_stress_case([](const PathCase& on) { check_paths(on, 12); });
}

TEST_CASE("path: along edges where that is the metric") {
    const PathCase on(jittered_grid(9, 2), path_options(GEOIDX_ENGINE_OVERLAY, GEOIDX_METRIC_EDGES));
    for (uint32_t t = 0; t < on.soup.triangles.size(); t += 7) {
        const auto from = corner(3, 0), to = corner(t, 1);
        const uint32_t source = on.soup.triangles[3][0], target = on.soup.triangles[t][1];
        double exact = 0;
        REQUIRE(geoidx_solver_distances(on.solver.get(), &source, 1, &target, 1, &exact) == GEOIDX_OK);
        const double length = path_length(on, from, to, GEOIDX_PATH_STRAIGHT);
        CHECK(length >= exact - 1e-9);
        CHECK(length <= exact * 1.01 + 1e-9);
        for (const geoidx_path_point& point : points_of(on))
            CHECK(*std::ranges::max_element(point.point.weights) == 1);
    }
}

TEST_CASE("path: from a point to itself, and within one triangle") {
    const PathCase on(torus(10, 8, 1, 0.4));
    std::mt19937_64 random(5);
    for (size_t i = 0; i < 8; ++i) {
        const auto from = random_point(on.soup, random, i);
        for (const uint32_t quality : {GEOIDX_PATH_STRAIGHT, GEOIDX_PATH_EXACT}) {
            CHECK(path_length(on, from, from, quality) == 0);
            auto to = random_point(on.soup, random, 0);
            to.triangle = from.triangle;
            CHECK(path_length(on, from, to, quality) ==
                  doctest::Approx((on.position(from) - on.position(to)).norm()).epsilon(1e-12));
        }
    }
}

// Two points at one place on both sides of a triangle without area: the way leads through that triangle.
TEST_CASE("path: between the sides of a triangle without area") {
    Soup soup;
    soup.positions = {{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, -1, 0}, {0.5, 1, 0.3}, {1.7, 0.8, 0.1}};
    soup.triangles = {{0, 1, 3}, {0, 2, 1}, {0, 2, 4}, {2, 1, 5}};
    const PathCase on(soup);
    geoidx_surface_point below{}, above{};
    below.triangle = 0;
    above.triangle = 2;
    for (const double share : {0.25, 0.5, 0.375}) {
        const double weights_below[] = {1 - share, share, 0}, weights_above[] = {1 - 2 * share, 2 * share, 0};
        std::ranges::copy(weights_below, below.weights);
        std::ranges::copy(weights_above, above.weights);
        for (const uint32_t quality : {GEOIDX_PATH_STRAIGHT, GEOIDX_PATH_EXACT}) {
            CHECK(path_length(on, below, above, quality) == 0);
            CHECK(path_length(on, above, below, quality) == 0);
        }
    }
}

// A share of a triangle that is rounding makes no other point: here the way turns around a vertex right
// there.
TEST_CASE("path: from a point that is at a vertex but for rounding") {
    const PathCase on(cone(saddle_rays(10, 0.9), 4));
    std::mt19937_64 random(8);
    for (uint32_t t = 0; t < on.soup.triangles.size(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            const auto from = corner(t, k), to = random_point(on.soup, random, k);
            auto near = from;
            near.weights[k] = 1 - 2e-16;
            near.weights[(k + 1) % 3] = 1e-16;
            for (const uint32_t quality : {GEOIDX_PATH_STRAIGHT, GEOIDX_PATH_EXACT})
                CHECK(path_length(on, near, to, quality) == path_length(on, from, to, quality));
        }
}

TEST_CASE("path: bad input is refused by name") {
    const PathCase on(torus(10, 8, 1, 0.4)), other(torus(10, 8, 1, 0.5));
    const auto fine = corner(0, 0);
    auto bad = fine;
    double length = 0;
    const auto path = [&](const geoidx_surface* surface, const geoidx_surface_point* from,
                          const geoidx_surface_point* to, uint32_t quality, double* out) {
        return geoidx_query_path(on.query.get(), surface, from, to, quality, out);
    };
    const geoidx_surface* surface = on.surface.get();
    check_refused(geoidx_query_path(nullptr, surface, &fine, &fine, 0, &length),
                  GEOIDX_ERROR_INVALID_ARGUMENT, "query is NULL");
    check_refused(path(nullptr, &fine, &fine, 0, &length), GEOIDX_ERROR_INVALID_ARGUMENT, "surface is NULL");
    check_refused(path(surface, nullptr, &fine, 0, &length), GEOIDX_ERROR_INVALID_ARGUMENT, "source is NULL");
    check_refused(path(surface, &fine, nullptr, 0, &length), GEOIDX_ERROR_INVALID_ARGUMENT, "target is NULL");
    check_refused(path(surface, &fine, &fine, 0, nullptr), GEOIDX_ERROR_INVALID_ARGUMENT, "length is NULL");
    check_refused(path(surface, &fine, &fine, 2, &length), GEOIDX_ERROR_INVALID_ARGUMENT, "quality");
    check_refused(path(other.surface.get(), &fine, &fine, 0, &length), GEOIDX_ERROR_MESH_MISMATCH,
                  "another mesh");
    bad.weights[1] = -0.5;
    check_refused(path(surface, &fine, &bad, 0, &length), GEOIDX_ERROR_INVALID_ARGUMENT,
                  "target has the weight");
    bad.weights[1] = 0.5;
    check_refused(path(surface, &bad, &fine, 0, &length), GEOIDX_ERROR_INVALID_ARGUMENT, "in sum");
    bad = corner(static_cast<uint32_t>(on.soup.triangles.size()), 0);
    check_refused(path(surface, &bad, &fine, 0, &length), GEOIDX_ERROR_INVALID_ARGUMENT, "triangle");

    const auto far = corner(70, 1);
    REQUIRE(path(surface, &fine, &far, 0, &length) == GEOIDX_OK);
    uint64_t count = 0;
    std::array<geoidx_path_point, 1> one{};
    check_refused(geoidx_query_path_points(on.query.get(), one.data(), 1, &count),
                  GEOIDX_ERROR_INVALID_ARGUMENT, "capacity");
    CHECK(count > 1);
    check_refused(geoidx_query_path_points(on.query.get(), nullptr, 1, &count), GEOIDX_ERROR_INVALID_ARGUMENT,
                  "points is NULL");
    check_refused(geoidx_query_path_points(on.query.get(), one.data(), 1, nullptr),
                  GEOIDX_ERROR_INVALID_ARGUMENT, "count is NULL");
}
