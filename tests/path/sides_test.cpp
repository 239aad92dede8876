// Paths beside a vertex that is passed on the wrong side.
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "src/path/sides.h"
#include "src/path/straighten.h"
#include "src/path/strip_search.h"
#include "tests/support/surfaces.h"

using namespace geodesic;

namespace {

constexpr uint32_t RAYS = 25, RINGS = 4, RING = 3, TARGET_RAY = 12;

uint32_t vertex_of(uint32_t ray, uint32_t ring) { return 1 + ray + RAYS * (ring - 1); }

SurfacePoint point_of(const Surface& surface, uint32_t vertex) {
    SurfacePoint point{*surface.vertex_faces[vertex].begin(), {}};
    point.weights[corner_of(surface, point.face, vertex)] = 1;
    return point;
}

double across(double angle, double a, double b) {
    return std::sqrt(a * a + b * b - 2 * a * b * std::cos(angle));
}

}

TEST_CASE("sides: the shorter way around a cone, from the longer one") {
    const auto rays = test::cone_rays(RAYS, 0.3);
    const double facet = std::acos(rays[0].dot(rays[1])), radius = double{RING} / RINGS;
    REQUIRE((RAYS - TARGET_RAY) * facet < std::numbers::pi);
    const Surface surface = test::surface_of(test::cone(rays, RINGS));
    // Of one half of the cone, and of its apex, the search is told that there is no way.
    const TargetDistances distances{[&](uint32_t vertex) {
        if (vertex == 0) return UNREACHABLE;
        const uint32_t ray = (vertex - 1) % RAYS, steps = ray == 0 ? RAYS - TARGET_RAY : ray - TARGET_RAY;
        if (ray > 0 && ray < TARGET_RAY) return UNREACHABLE;
        return across(steps * facet, radius, double((vertex - 1) / RAYS + 1) / RINGS);
    }};
    auto strip = search_strip(surface, point_of(surface, vertex_of(0, RING)),
                              point_of(surface, vertex_of(TARGET_RAY, RING)), distances);
    REQUIRE(strip);
    StripWay way = straighten(surface, std::move(*strip));
    CHECK(way.path.length ==
          doctest::Approx(across((RAYS - TARGET_RAY) * facet, radius, radius)).epsilon(1e-9));
    try_other_sides(surface, {&way, 1});
    CHECK(way.path.length == doctest::Approx(across(TARGET_RAY * facet, radius, radius)).epsilon(1e-9));
    CHECK(way.path.length == doctest::Approx(length_of(surface, way.strip, way.path.shares)).epsilon(1e-12));
}
