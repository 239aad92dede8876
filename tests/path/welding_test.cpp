// Surfaces that are welded as their index, and those that are not.
#include <array>
#include <cmath>

#include "tests/capi/refusals.h"
#include "tests/path/path_cases.h"

using namespace geodesic::test;

namespace {

constexpr double GAP = 0.01;

// Two squares of 4 x 4 in one plane, a gap between their sides.
Soup two_squares() {
    Soup left = grid(4, 4, 4, 4), right = left;
    for (auto& position : right.positions) position[0] += 4 + GAP;
    return joined(left, right);
}

geoidx_build_options welding(double tolerance, uint32_t metric) {
    geoidx_build_options options = path_options(GEOIDX_ENGINE_OVERLAY, metric);
    options.weld_tolerance = tolerance;
    return options;
}

void check_all_refused(const PathCase& on, const geoidx_surface* surface) {
    const geoidx_surface_point from{0, 0, {1, 0, 0}}, to{63, 0, {0, 0, 1}};
    double length = 0;
    float distance = 0;
    std::vector<float> distances(on.soup.vertex_count());
    const auto check = [](geoidx_status status) {
        check_refused(status, GEOIDX_ERROR_INVALID_ARGUMENT, "different vertices");
    };
    check(geoidx_query_path(on.query.get(), surface, &from, &to, GEOIDX_PATH_STRAIGHT, &length));
    check(geoidx_query_point_sssd(on.query.get(), surface, &from, &to, &distance));
    check(geoidx_query_point_msad(on.query.get(), surface, &from, 1, nullptr, distances.data(),
                                  on.soup.vertex_count()));
    check(geoidx_query_prepare_target(on.query.get(), surface, &to));
}

}

TEST_CASE("welding: a surface is refused unless it is welded as the index") {
    for (const uint32_t metric : {GEOIDX_METRIC_EXACT, GEOIDX_METRIC_EDGES}) {
        CAPTURE(metric);
        const PathCase welded(two_squares(), welding(2 * GAP, metric));
        const PathCase apart(two_squares(), welding(0, metric));
        check_all_refused(welded, apart.surface.get());
        check_all_refused(apart, welded.surface.get());
    }
}

TEST_CASE("welding: of the same tolerance, paths lead over the gap") {
    const PathCase welded(two_squares(), welding(2 * GAP, GEOIDX_METRIC_EXACT));
    const geoidx_surface_point from{0, 0, {1, 0, 0}};
    geoidx_surface_point to{};
    const std::array<double, 3> far_corner{8 + GAP, 4, 0};
    REQUIRE(geoidx_closest_point(welded.surface.get(), far_corner.data(), &to, nullptr) == GEOIDX_OK);
    REQUIRE(welded.position(from).norm() == 0);
    double length = 0;
    REQUIRE(geoidx_query_path(welded.query.get(), welded.surface.get(), &from, &to, GEOIDX_PATH_EXACT,
                              &length) == GEOIDX_OK);
    CHECK(std::abs(length - std::hypot(8 + GAP, 4)) <= 1e-9);
}
