// Paths that lead back over windows: as long as the windows say.
#include <random>

#include <doctest/doctest.h>

#include "src/path/straighten.h"
#include "src/path/window_trace.h"
#include "tests/path/path_cases.h"
#include "tests/support/surfaces.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

SurfacePoint internal(const geoidx_surface_point& point) {
    return {point.triangle, {point.weights[0], point.weights[1], point.weights[2]}};
}

// A strip of faces proves that there is a path of its length, so that both together are right.
void check_traces(const Soup& soup, size_t count) {
    const Intake intake = intake_of(soup);
    const Surface surface = surface_of(soup);
    const ExactMetric metric(intake.mesh);
    const auto solver = metric.make_window_solver();
    std::mt19937_64 random(11);
    size_t traced = 0;
    for (size_t i = 0; i < count; ++i) {
        CAPTURE(i);
        const SurfacePoint source = internal(random_point(soup, random, i)),
                           target = internal(random_point(soup, random, i / 4));
        solver->solve({{}, {}, {&source, 1}, {&target, 1}});
        auto strip = trace_back(metric.mesh(), *solver, target, source);
        const double distance = solver->point_distance(0);
        CHECK(strip.has_value() == (distance < UNREACHABLE));
        if (!strip) continue;
        ++traced;
        REQUIRE(strip->portals.size() + 1 == strip->faces.size());
        CHECK((position_of(surface, strip->source) - position_of(surface, target)).norm() < 1e-12);
        CHECK((position_of(surface, strip->target) - position_of(surface, source)).norm() < 1e-12);
        for (size_t k = 0; k < strip->portals.size(); ++k)
            for (const uint32_t vertex : {strip->portals[k].a, strip->portals[k].b})
                for (const uint32_t face : {strip->faces[k], strip->faces[k + 1]})
                    CHECK(std::ranges::count(surface.faces[face], vertex) == 1);
        const StripWay way = straighten(surface, std::move(*strip));
        CHECK(way.path.length == doctest::Approx(distance).epsilon(1e-9));
    }
    CHECK(traced > 0);
}

}

TEST_CASE("window trace: on meshes of all kinds") {
    size_t number = 0;
    for (const Soup& soup : path_soups()) {
        CAPTURE(number);
        ++number;
        check_traces(soup, 60);
    }
}

TEST_CASE("window trace: on spikes, where many ways are nearly as short") {
    std::mt19937_64 random(17);
    Soup soup = grid(20, 20, 20, 20);
    for (auto& position : soup.positions) position.z() = uniform(random, 0, 20);
    check_traces(soup, 100);
}

TEST_CASE("window trace: on random triangles between a few points") {
    for (uint64_t seed = 0; seed < 60; ++seed) {
        CAPTURE(seed);
        std::mt19937_64 random(seed);
        check_traces(random_soup(random, 7 + seed % 6, 4 + seed % 9), 10);
    }
}
