// The exact metric with a tolerance: windows beside each other are joined.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "src/metric/envelope.h"
#include "src/metric/window_propagation.h"
#include "tests/metric/windows.h"
#include "tests/support/meshes.h"
#include "tests/support/oracles.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

struct Case {
    std::string name;
    Soup soup;
};

// What a lathe turns: long triangles around a curved profile, of which rings are near each other.
Soup turned(uint32_t sides, uint32_t rings) {
    Soup soup = prism(sides, rings, 1);
    for (Eigen::Vector3d& p : soup.positions) {
        const double height = p.z(), radius = 0.1 * (2 + std::sin(5 * height) + 0.2 * std::sin(30 * height));
        p.head<2>() *= radius / p.head<2>().norm();
    }
    return soup;
}

Soup hills(uint32_t cells, double width, double height) {
    Soup soup = grid(cells, cells, width, 1);
    for (Eigen::Vector3d& p : soup.positions) p.z() = height * std::sin(9 * p.x()) * std::cos(7 * p.y());
    return soup;
}

std::vector<Case> cases() {
    return {{"turned", turned(16, 100)},
            {"hills", hills(30, 1, 0.1)},
            {"stretched hills", hills(40, 8, 0.2)},
            {"bumpy sphere", bumpy_sphere(4, 1)},
            {"torus", torus(60, 12, 2, 0.7)},
            {"saddle", cone(saddle_rays(24, 0.8), 20)},
            {"annulus", annulus(40, 8)},
            {"edges of three faces", comb(4)}};
}

struct Errors {
    double mean = 0, largest = 0;
};

// Of fields from some vertices, relative to those without a tolerance.
Errors errors_with(const Mesh& mesh, double tolerance) {
    const auto exact = ExactMetric(mesh).make_solver(), tolerant = ExactMetric(mesh, tolerance).make_solver();
    std::mt19937_64 random(4);
    Errors errors;
    double count = 0;
    for (int i = 0; i < 8; ++i) {
        const auto source = static_cast<uint32_t>(random() % mesh.vertex_count());
        const auto expected = field(mesh, *exact, {&source, 1}), found = field(mesh, *tolerant, {&source, 1});
        for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
            CHECK((expected[v] == UNREACHABLE) == (found[v] == UNREACHABLE));
            if (v == source || expected[v] == UNREACHABLE) continue;
            const double error = std::abs(found[v] / expected[v] - 1);
            errors.mean += error;
            errors.largest = std::max(errors.largest, error);
            ++count;
        }
    }
    errors.mean /= count;
    return errors;
}

// How far a place is off the line from a place of the edge to the source of a window.
double off_ray(const Window& window, double t, double x, double y) {
    const double across = window.x - t;
    return std::abs(across * y - window.y * (x - t)) / std::hypot(across, window.y);
}

}

TEST_CASE("tolerance: distances are off by about that share") {
    for (const auto& [name, soup] : cases()) {
        const auto& surface_name = name; // clang 14 captures no structured binding
        CAPTURE(surface_name);
        const Mesh mesh = mesh_of(soup);
        for (const double tolerance : {1e-6, 1e-5, 1e-4}) {
            CAPTURE(tolerance);
            const Errors errors = errors_with(mesh, tolerance);
            CHECK(errors.mean < 3 * tolerance);
            CHECK(errors.largest < 60 * tolerance);
        }
    }
}

TEST_CASE("tolerance: windows are joined where triangles are long") {
    CHECK(errors_with(mesh_of(turned(16, 100)), 1e-5).mean > 1e-7);
}

TEST_CASE("tolerance: targets, several sources and points are answered within it") {
    constexpr double TOLERANCE = 1e-5, MOST = 60 * TOLERANCE;
    for (const auto& [name, soup] : cases()) {
        const auto& surface_name = name; // clang 14 captures no structured binding
        CAPTURE(surface_name);
        const Mesh mesh = mesh_of(soup);
        const auto exact = ExactMetric(mesh).make_solver(),
                   tolerant = ExactMetric(mesh, TOLERANCE).make_solver();
        std::mt19937_64 random(5);
        const auto any_vertex = [&] { return static_cast<uint32_t>(random() % mesh.vertex_count()); };
        const auto any_point = [&] {
            return SurfacePoint{static_cast<uint32_t>(random() % mesh.face_count()), {0.5, 0.2, 0.3}};
        };
        for (int i = 0; i < 20; ++i) {
            const std::vector<uint32_t> sources{any_vertex(), any_vertex(), any_vertex()},
                targets{any_vertex(), any_vertex()};
            const std::vector<SurfacePoint> source_points{any_point()},
                target_points{any_point(), any_point()};
            const FieldRequest requests[] = {{{sources.data(), 1}, targets, {}, {}},
                                             {sources, targets, {}, target_points},
                                             {{}, targets, source_points, target_points}};
            for (const FieldRequest& request : requests) {
                exact->solve(request);
                tolerant->solve(request);
                for (const uint32_t target : targets)
                    CHECK(tolerant->distance(target) ==
                          doctest::Approx(exact->distance(target)).epsilon(MOST));
                for (size_t t = 0; t < request.target_points.size(); ++t)
                    CHECK(tolerant->point_distance(t) ==
                          doctest::Approx(exact->point_distance(t)).epsilon(MOST));
            }
        }
    }
}

TEST_CASE("tolerance: a joined window has the outer rays and the distances of both") {
    std::mt19937_64 random(8);
    size_t joined_ones = 0;
    for (int i = 0; i < 20000; ++i) {
        const double tolerance = std::pow(10, uniform(random, -6, -2));
        const double begin = uniform(random, 0, 1), between = begin + uniform(random, 1e-3, 0.1),
                     end = between + uniform(random, 1e-3, 0.1);
        const double x = uniform(random, -1, 2), y = uniform(random, 0.1, 1), sigma = uniform(random, 0, 1);
        // The second sees a source that is turned around the place where both end.
        const double turn = std::pow(10, uniform(random, -4, -1)) * (random() % 2 ? 1 : -1);
        const double across = x - between;
        const Window a = window_over(begin, between, x, y, sigma, 0),
                     b = window_over(between, end, between + across * std::cos(turn) - y * std::sin(turn),
                                     across * std::sin(turn) + y * std::cos(turn), sigma, 0);
        if (!(b.y > 0)) continue;
        const auto both = join_windows(a, b, tolerance);
        if (!both) continue;
        ++joined_ones;
        CHECK(both->begin == begin);
        CHECK(both->end == end);
        const double far = std::abs(both->x) + both->y;
        CHECK(off_ray(a, begin, both->x, both->y) < 1e-9 * (1 + far));
        CHECK(off_ray(b, end, both->x, both->y) < 1e-9 * (1 + far));
        for (const double t : {begin, between})
            CHECK(std::abs(both->distance_at(t) / a.distance_at(t) - 1) < 1.01 * tolerance);
        for (const double t : {between, end})
            CHECK(std::abs(both->distance_at(t) / b.distance_at(t) - 1) < 1.01 * tolerance);
        CHECK(both->begin_distance == doctest::Approx(both->distance_at(begin)).epsilon(1e-14));
        CHECK(both->end_distance == doctest::Approx(both->distance_at(end)).epsilon(1e-14));
    }
    CHECK(joined_ones > 3000);
}

TEST_CASE("tolerance: windows that are no one light stay two") {
    const Window a = window_over(0.2, 0.4, 0.3, 1, 0.5, 0);
    const auto joins = [&](Window b, void (*change)(Window&), double tolerance = 1e-3) {
        change(b);
        b.begin_distance = b.distance_at(b.begin);
        b.end_distance = b.distance_at(b.end);
        return join_windows(a, b, tolerance).has_value();
    };
    const Window same = window_over(0.4, 0.6, 0.3, 1, 0.5, 0);
    CHECK(joins(same, [](Window&) {}));
    CHECK(!joins(same, [](Window& b) { b.begin = 0.41; }));  // apart
    CHECK(!joins(same, [](Window& b) { b.sigma = 0.49; }));  // longer on one side than on the other
    CHECK(!joins(same, [](Window& b) { b.nearest = 1; }));   // another source of the solve
    CHECK(!joins(same, [](Window& b) { b.from_face = 1; })); // the other side
    CHECK(!joins(same, [](Window& b) { b.pending = 0; }));   // propagated already
    CHECK(!joins(same, [](Window& b) { b.y = 0; }));         // in line with the edge
    // Whatever the tolerance, where outer rays do not meet, or meet far away.
    CHECK(joins(
        same, [](Window& b) { b.x = 0.35; }, 10));
    CHECK(!joins(
        same, [](Window& b) { b.x = 0.75; }, 10));
    CHECK(!joins(
        same, [](Window& b) { b.x = 0.699; }, 10));
    // Longer by 0.04 behind the place where one ends than before it, though outer rays and lengths agree.
    CHECK(!join_windows(window_over(0, 0.2191367113, 0.371560298901, 0.441028051401, 0.177728057919, 0),
                        window_over(0.2191367113, 0.574723375741, 0.297199090398, 0.602451944433, 0, 0),
                        1e-3));
    // What is propagated already is not changed.
    Window nearly = window_over(0.4, 0.6, 0.29, 1, 0.5, 0), first = a;
    CHECK(join_windows(first, nearly, 10));
    first.pending = nearly.pending = 0;
    CHECK(!join_windows(first, nearly, 10));
}

TEST_CASE("tolerance: windows of one source are one, without a tolerance and propagated or not") {
    Window first = window_over(0.2, 0.4, 0.3, 1, 0.5, 0), second = window_over(0.4, 0.6, 0.3, 1, 0.5, 0);
    for (const bool is_propagated : {false, true}) {
        if (is_propagated) first.pending = second.pending = 0;
        const auto both = join_windows(first, second, 0);
        REQUIRE(both);
        CHECK(both->begin == first.begin);
        CHECK(both->end == second.end);
        CHECK(both->begin_distance == first.begin_distance);
        CHECK(both->end_distance == second.end_distance);
        CHECK(both->x == first.x);
        CHECK(both->y == first.y);
        CHECK(both->sigma == first.sigma);
        CHECK(bool{both->pending == 1} == !is_propagated);
    }
    second.x = 0.29;
    CHECK(!join_windows(first, second, 0));
}

TEST_CASE("tolerance: an envelope has fewer windows, and its distances stay") {
    // Light of a source that moves along a circle around the middle of the edge, as behind a curved surface.
    std::vector<Window> windows;
    constexpr int COUNT = 200;
    for (int i = 0; i < COUNT; ++i) {
        const double begin = i / double{COUNT}, turn = 1e-3 * begin;
        windows.push_back(
            window_over(begin, (i + 1) / double{COUNT}, 0.5 + 3 * std::sin(turn), 3 * std::cos(turn), 0, 0));
    }
    const auto as_given = windows;
    auto scratch = windows;
    CHECK(Envelope(0).merge({}, scratch).size() > COUNT / 2);
    Envelope envelope(1e-5);
    const auto merged = envelope.merge({}, windows);
    CHECK(merged.size() < COUNT / 4);
    for (const Window& window : as_given) {
        const double t = 0.5 * (window.begin + window.end);
        const auto over = std::ranges::find_if(merged, [&](const Window& w) { return w.end >= t; });
        REQUIRE(over != merged.end());
        CHECK(over->distance_at(t) == doctest::Approx(window.distance_at(t)).epsilon(3e-4));
    }
}
