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
#include "tests/support/sanitized.h"

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

// Needles on an edge that four of them share, of a terrain whose points came in clusters.
Soup needles() {
    Soup soup;
    soup.positions = {
        {0.0007059982, 0.00095821226, -0.48160711},  {3.7435676e-07, 5.2536026e-05, -0.48179534},
        {1.3080026e-08, 0.0040499419, -0.47843975},  {0.00065180827, 0.0011618708, -0.48134749},
        {0.0015078533, 0.0055312309, -0.47807497},   {1.3882666e-16, 0.00032874472, -0.48153988},
        {0.00047710207, 0.00054128092, -0.48178035}, {0.00010031503, 0.00052077705, -0.48144644},
        {0.001315755, 0.00081001215, -0.48251174},   {0.00021256462, 0.00036478706, -0.48169262},
        {9.4755363e-10, 0.0031737619, -0.4790973},   {0.00024819642, 0.0027453823, -0.47956448},
        {4.0560997e-05, 0.0029911101, -0.47925789},  {0.00022244788, 0.00050085666, -0.48157253},
        {1.3544859e-06, 0.0044498561, -0.47815877},  {5.1069268e-06, 3.5471333e-05, -0.48181531},
        {4.6436682e-05, 0.00037245397, -0.48153837}, {0.0010406984, 0.0028030738, -0.48013001},
        {1.656894e-05, 0.00034607586, -0.48153769},  {0.00037278506, 0.005654362, -0.47741751},
        {1.5083993e-06, 0.00032406052, -0.48154544}, {9.5764481e-05, 0.006007176, -0.47718579},
        {0.00011280423, 0.0050010817, -0.47780405},  {3.0978925e-10, 0.0001492477, -0.48170543},
        {0.00023342792, 0.00040582397, -0.48167293}, {4.337395e-07, 4.0673628e-05, -0.4818064},
        {1.1712523e-05, 0.00031876334, -0.48155881}, {3.2389672e-10, 0.0058063125, -0.47730434},
        {7.4690718e-09, 0.0046259739, -0.47803874},  {3.5674444e-15, 2.9835562e-05, -0.48181608},
        {1.3851943e-12, 0.0034245034, -0.47890361},  {4.0220707e-14, 3.0291696e-05, -0.48181565},
        {8.4292447e-13, 0.0048939651, -0.47786133},  {3.7847387e-11, 0.0045467719, -0.4780923},
        {1.5285721e-11, 0.0028863265, -0.47932442},  {1.1045125e-10, 0.0042019358, -0.4783314},
        {0.00063369698, 0.0025678281, -0.47998797},  {1.0982204e-15, 0.00020191815, -0.48165675},
        {0.00056904638, 0.00085485108, -0.48156579}, {0.00064391322, 0.00068856579, -0.48181035},
        {0.00061815422, 0.0011325057, -0.48134221},  {1.7871626e-09, 8.9468703e-05, -0.48176077},
        {0.0011513157, 0.0017986503, -0.48125336},   {0.00023148764, 0.0026934285, -0.47959892},
        {8.2828231e-06, 1.7173703e-05, -0.4818351}};
    soup.triangles = {{27, 19, 21}, {32, 28, 22}, {28, 32, 33}, {4, 19, 22},  {14, 33, 35}, {2, 35, 30},
                      {10, 30, 34}, {11, 12, 34}, {11, 43, 36}, {42, 17, 36}, {38, 0, 40},  {39, 38, 6},
                      {20, 18, 5},  {16, 18, 26}, {24, 13, 7},  {13, 24, 6},  {7, 16, 9},   {31, 41, 1},
                      {31, 15, 29}, {15, 25, 29}, {29, 25, 1},  {41, 23, 29}, {41, 29, 1},  {5, 23, 29},
                      {23, 37, 29}, {29, 23, 1},  {29, 37, 1},  {3, 0, 8},    {3, 8, 42},   {31, 44, 1},
                      {44, 31, 29}};
    return soup;
}

}

TEST_CASE("tolerance: where joined windows multiply, distances are exact") {
    const Mesh mesh = mesh_of(needles());
    const auto exact = ExactMetric(mesh).make_solver(),
               with_tolerance = ExactMetric(mesh, 1e-5).make_solver();
    for (uint32_t source = 0; source < mesh.vertex_count(); ++source) {
        // A part of a field, and points, leave nothing behind.
        const SurfacePoint in_face{source % mesh.face_count(), {0.2, 0.3, 0.5}};
        with_tolerance->solve({{}, {}, {&in_face, 1}, {&in_face, 1}, 1e-3, 3});
        exact->solve({&source, 1}, {});
        with_tolerance->solve({&source, 1}, {});
        for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
            if (exact->distance(v) == UNREACHABLE)
                CHECK(with_tolerance->distance(v) == UNREACHABLE);
            else
                CHECK(std::abs(with_tolerance->distance(v) - exact->distance(v)) <= 1e-14);
        }
    }
}

TEST_CASE("tolerance: distances are off by about that share" * doctest::skip(SANITIZED)) {
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

TEST_CASE("tolerance: targets, several sources and points are answered within it" *
          doctest::skip(SANITIZED)) {
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
    CHECK(Envelope().merge({}, scratch).size() > COUNT / 2);
    Envelope envelope;
    const auto merged = envelope.merge({}, windows, 1e-5);
    CHECK(merged.size() < COUNT / 4);
    for (const Window& window : as_given) {
        const double t = 0.5 * (window.begin + window.end);
        const auto over = std::ranges::find_if(merged, [&](const Window& w) { return w.end >= t; });
        REQUIRE(over != merged.end());
        CHECK(over->distance_at(t) == doctest::Approx(window.distance_at(t)).epsilon(3e-4));
    }
}
