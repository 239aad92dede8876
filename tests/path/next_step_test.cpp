// Walks to a target, step by step, compared with the exact metric.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tests/path/walks.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

namespace {

// Whoever follows the steps goes along the straight path, or a shorter one; whoever asks again within
// triangles, too.
void check_walks(const PathCase& on, size_t count) {
    std::mt19937_64 random(4);
    for (size_t i = 0; i < count; ++i) {
        const auto from = random_point(on.soup, random, i), target = random_point(on.soup, random, i / 4);
        const double exact = on.exact(from, target);
        CAPTURE(i);
        CAPTURE(exact);
        if (exact == std::numeric_limits<double>::infinity()) {
            prepare(on, target);
            Step step;
            check_refused(geoidx_query_next_step(on.query.get(), on.surface.get(), &from, step.points.data(),
                                                 &step.distance),
                          GEOIDX_ERROR_NO_PATH, "component");
            continue;
        }
        double straight = 0;
        require_success(geoidx_query_path(on.query.get(), on.surface.get(), &from, &target,
                                          GEOIDX_PATH_STRAIGHT, &straight));
        for (const double share : {1.0, 0.6}) {
            const double length = walk(on, from, target, share);
            CHECK(length >= exact * (1 - 1e-9) - CLOSE);
            CHECK(length <= straight * (1 + 1e-9) + CLOSE);
        }
    }
}

}

TEST_CASE("next step: walks end at the target, and are little longer than the shortest" *
          doctest::skip(SANITIZED)) {
    size_t number = 0;
    for (const Soup& soup : path_soups()) {
        ++number;
        CAPTURE(number);
        check_walks(PathCase(soup), 40);
    }
}

TEST_CASE("next step: by the graph engine, too") {
    check_walks(PathCase(joined(torus(12, 8, 1, 0.4), comb(1)), path_options(GEOIDX_ENGINE_GRAPH)), 24);
}

TEST_CASE("next step: walks on stress meshes end at the target") {
    for_each_stress_case([](const PathCase& on) { check_walks(on, 12); });
}

TEST_CASE("next step: the distance is that of the index, and other questions do not disturb it" *
          doctest::skip(SANITIZED)) {
    const PathCase on(bumpy_sphere(3, 5));
    std::mt19937_64 random(6);
    for (size_t i = 0; i < 30; ++i) {
        const auto from = random_point(on.soup, random, i), target = random_point(on.soup, random, i / 4),
                   other = random_point(on.soup, random, i);
        prepare(on, target);
        const Step before = step_from(on, from);
        CHECK(before.distance == doctest::Approx(on.exact(from, target)).epsilon(0.02));
        double length = 0;
        require_success(
            geoidx_query_path(on.query.get(), on.surface.get(), &other, &from, GEOIDX_PATH_EXACT, &length));
        on.sssd(other, from);
        const Step after = step_from(on, from);
        CHECK(after.distance == doctest::Approx(before.distance).epsilon(1e-12));
        CHECK(after.points[1].point.triangle == before.points[1].point.triangle);
        for (size_t k = 0; k < 3; ++k)
            CHECK(after.points[1].point.weights[k] ==
                  doctest::Approx(before.points[1].point.weights[k]).epsilon(1e-9));
    }
}

// From another point of a triangle, the shortest way may leave it over another edge.
TEST_CASE("next step: from anywhere in the triangles on the way it is little longer than a path") {
    std::mt19937_64 random(9);
    for (const Soup& soup : {cube(1), cube(2), sphere(0), bumpy_sphere(1, 5), split_edges(4)}) {
        const PathCase on(soup);
        for (size_t i = 0; i < 60; ++i) {
            const auto target = random_point(soup, random, 1);
            prepare(on, target);
            auto from = random_point(soup, random, 1);
            for (size_t k = 0; k < 4; ++k) {
                const Step step = step_from(on, from);
                check_step(on, from, step);
                double straight = 0;
                require_success(geoidx_query_path(on.query.get(), on.surface.get(), &from, &target,
                                                  GEOIDX_PATH_STRAIGHT, &straight));
                CHECK(step.distance <= 1.05 * straight);
                CHECK(step.distance >= on.exact(from, target) * (1 - 1e-7)); // split edges are rounded
                const uint32_t triangle = step.points[1].point.triangle;
                from = random_point(soup, random, 1);
                from.triangle = triangle;
            }
        }
    }
}

TEST_CASE("next step: from corner to corner where edges are the metric") {
    for (const uint32_t engine : {GEOIDX_ENGINE_OVERLAY, GEOIDX_ENGINE_GRAPH}) {
        const PathCase on(jittered_grid(9, 2), path_options(engine, GEOIDX_METRIC_EDGES));
        for (uint32_t t = 0; t < on.soup.triangles.size(); t += 7) {
            const uint32_t source = on.soup.triangles[3][0], target = on.soup.triangles[t][1];
            double exact = 0;
            REQUIRE(geoidx_solver_distances(on.solver.get(), &source, 1, &target, 1, &exact) == GEOIDX_OK);
            const double length = walk(on, corner(3, 0), corner(t, 1));
            CHECK(length >= exact - CLOSE);
            CHECK(length <= exact * 1.01 + CLOSE);
        }
    }
}

TEST_CASE("next step: bad input is refused by name") {
    const PathCase on(torus(10, 8, 1, 0.4)), other(torus(10, 8, 1, 0.5));
    const auto fine = corner(0, 0);
    auto bad = fine;
    bad.weights[1] = -0.5;
    Step step;
    geoidx_query* const query = on.query.get();
    const geoidx_surface* const surface = on.surface.get();
    const auto refused = [](geoidx_status status, const char* what) {
        check_refused(status, GEOIDX_ERROR_INVALID_ARGUMENT, what);
    };
    geoidx_path_point* const points = step.points.data();
    refused(geoidx_query_next_step(query, surface, &fine, points, nullptr), "no target");
    refused(geoidx_query_prepare_target(nullptr, surface, &fine), "query is NULL");
    refused(geoidx_query_prepare_target(query, nullptr, &fine), "surface is NULL");
    refused(geoidx_query_prepare_target(query, surface, nullptr), "target is NULL");
    refused(geoidx_query_prepare_target(query, surface, &bad), "target has the weight");
    check_refused(geoidx_query_prepare_target(query, other.surface.get(), &fine), GEOIDX_ERROR_MESH_MISMATCH,
                  "another mesh");
    prepare(on, corner(70, 1));
    refused(geoidx_query_next_step(nullptr, surface, &fine, points, nullptr), "query is NULL");
    refused(geoidx_query_next_step(query, nullptr, &fine, points, nullptr), "surface is NULL");
    refused(geoidx_query_next_step(query, surface, nullptr, points, nullptr), "from is NULL");
    refused(geoidx_query_next_step(query, surface, &fine, nullptr, nullptr), "step is NULL");
    refused(geoidx_query_next_step(query, surface, &bad, points, nullptr), "from has the weight");
    check_refused(geoidx_query_next_step(query, other.surface.get(), &fine, points, nullptr),
                  GEOIDX_ERROR_MESH_MISMATCH, "another mesh");
    require_success(geoidx_query_next_step(query, surface, &fine, points, nullptr));
    // One that fails leaves none.
    refused(geoidx_query_prepare_target(query, surface, &bad), "target has the weight");
    refused(geoidx_query_next_step(query, surface, &fine, points, nullptr), "no target");
}
