// The nearest point of the surface, compared with all faces one by one.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <doctest/doctest.h>

#include "tests/capi/refusals.h"
#include "tests/support/handles.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;
using Eigen::Vector3d;

namespace {

SurfaceHandle surface_of(const Soup& soup, double weld_tolerance = 0) {
    const geoidx_mesh view = view_of(soup);
    geoidx_surface_options options;
    geoidx_surface_options_init(&options);
    options.weld_tolerance = weld_tolerance;
    geoidx_surface* surface = nullptr;
    REQUIRE(geoidx_surface_create(&view, &options, &surface) == GEOIDX_OK);
    return SurfaceHandle(surface);
}

// By halving the triangle's parameters to the least of a convex function: another way than the library's.
double distance_to_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& p) {
    const auto least_over = [](const auto& value) {
        double low = 0, high = 1;
        for (int i = 0; i < 45; ++i) {
            const double first = low + (high - low) / 3, second = high - (high - low) / 3;
            if (value(first) < value(second))
                high = second;
            else
                low = first;
        }
        return value((low + high) / 2);
    };
    return least_over([&](double s) {
        const Vector3d from = a + s * (b - a), to = a + s * (c - a);
        return least_over([&](double t) { return (from + t * (to - from) - p).norm(); });
    });
}

// Some triangles without area, some twice, and unused vertices.
Soup dirty(Soup soup) {
    const uint32_t far = soup.vertex_count();
    soup.positions.push_back({90, 90, 90});
    soup.positions.push_back(soup.positions[soup.triangles[0][0]]);
    soup.triangles.insert(soup.triangles.begin(), {far, far, 1});
    soup.triangles.push_back({soup.triangles[4][1], soup.triangles[4][0], soup.triangles[4][2]});
    soup.triangles.push_back({far + 1, soup.triangles[1][0], soup.triangles[1][1]});
    return soup;
}

}

TEST_CASE("closest point: as near as the nearest of all triangles" * doctest::skip(SANITIZED)) {
    std::mt19937_64 random(7);
    for (const Soup& soup :
         {bumpy_sphere(2, 4), dirty(bumpy_sphere(1, 3)), joined(comb(1), cube(2)), grid(1, 1, 1, 1)}) {
        const SurfaceHandle surface = surface_of(soup);
        for (int i = 0; i < 30; ++i) {
            const Vector3d p{uniform(random, -1.5, 1.5), uniform(random, -1.5, 1.5),
                             uniform(random, -1.5, 1.5)};
            double expected = INFINITE;
            for (const auto& [a, b, c] : soup.triangles)
                if (a != b && b != c && c != a && soup.positions[a] != soup.positions[b] &&
                    soup.positions[a] != soup.positions[c])
                    expected = std::min(expected, distance_to_triangle(soup.positions[a], soup.positions[b],
                                                                       soup.positions[c], p));
            geoidx_surface_point point{};
            double distance = 0;
            REQUIRE(geoidx_closest_point(surface.get(), p.data(), &point, &distance) == GEOIDX_OK);
            CHECK(distance == doctest::Approx(expected).epsilon(1e-6).scale(1e-3));
            REQUIRE(point.triangle < soup.triangles.size());
            Vector3d found = Vector3d::Zero();
            for (size_t k = 0; k < 3; ++k) {
                CHECK(point.weights[k] >= 0);
                found += point.weights[k] * soup.positions[soup.triangles[point.triangle][k]];
            }
            CHECK((found - p).norm() == doctest::Approx(distance).epsilon(1e-12).scale(1e-6));
        }
    }
}

TEST_CASE("closest point: a corner of the surface, and the surface's own points") {
    const Soup soup = cube(3);
    const SurfaceHandle surface = surface_of(soup);
    geoidx_surface_point point{};
    double distance = 0;
    const std::array<double, 3> outside{-1, -1, -1}, on{0.25, 0.7, 1};
    REQUIRE(geoidx_closest_point(surface.get(), outside.data(), &point, &distance) == GEOIDX_OK);
    CHECK(distance == doctest::Approx(std::sqrt(3.0)).epsilon(1e-14));
    REQUIRE(geoidx_closest_point(surface.get(), on.data(), &point, nullptr) == GEOIDX_OK);
    REQUIRE(geoidx_closest_point(surface.get(), on.data(), &point, &distance) == GEOIDX_OK);
    CHECK(distance < 1e-15);
}

TEST_CASE("closest point: on and beside an edge no weight is negative, however it is rounded") {
    Soup soup;
    soup.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    soup.triangles = {{0, 1, 2}};
    const SurfaceHandle surface = surface_of(soup);
    std::mt19937_64 random(2);
    for (int i = 0; i < 2000; ++i) {
        const double x = i == 0 ? 0.7 : uniform(random, 0, 1);
        for (const double y : {1 - x, std::nextafter(1 - x, 0), std::nextafter(1 - x, 1)}) {
            const std::array<double, 3> position{x, y, 0};
            geoidx_surface_point point{};
            REQUIRE(geoidx_closest_point(surface.get(), position.data(), &point, nullptr) == GEOIDX_OK);
            for (const double weight : point.weights) CHECK((weight >= 0 && weight <= 1));
        }
    }
}

// What is beside an edge by less than callers' weights count is on the edge.
TEST_CASE("closest point: no weight is one that would count as 0 when it comes back") {
    const SurfaceHandle surface = surface_of(sphere(2));
    const auto positions = sphere(2).positions;
    const auto triangles = sphere(2).triangles;
    std::mt19937_64 random(4);
    for (int i = 0; i < 3000; ++i) {
        const auto& t = triangles[random() % triangles.size()];
        const double share = i % 3 == 0 ? 0 : uniform(random, 0, 1);
        const Eigen::Vector3d at = positions[t[0]] + share * (positions[t[1]] - positions[t[0]]) +
                                   1e-13 * uniform(random, -1, 1) * positions[t[2]];
        geoidx_surface_point point{};
        REQUIRE(geoidx_closest_point(surface.get(), at.data(), &point, nullptr) == GEOIDX_OK);
        for (const double weight : point.weights) CHECK((weight == 0 || weight >= 1e-12));
    }
}

TEST_CASE("closest point: surfaces of any size, and positions far away") {
    for (const double size : {1e-9, 1e-3, 1e9}) {
        CAPTURE(size);
        Soup soup = cube(3);
        for (Vector3d& position : soup.positions) position *= size;
        const SurfaceHandle surface = surface_of(soup);
        for (const double away : {0.0, size, 1e8 * size}) {
            const std::array<double, 3> position{size / 2, size / 4, size + away};
            geoidx_surface_point point{};
            double distance = 0;
            REQUIRE(geoidx_closest_point(surface.get(), position.data(), &point, &distance) == GEOIDX_OK);
            CHECK(distance <= away * (1 + 1e-12) + 1e-15 * size);
            CHECK(distance >= away * (1 - 1e-12));
        }
    }
}

// From there all of a plane is as far away as a double can tell.
TEST_CASE("closest point: from far above a square it is the foot, or beside it the edge") {
    const Soup soup = grid(10, 10, 1, 1);
    const SurfaceHandle surface = surface_of(soup);
    std::mt19937_64 random(5);
    for (const double height : {1.0, 1e4, 1e8, -1e9})
        for (int i = 0; i < 20; ++i) {
            const std::array<double, 3> position{uniform(random, -1, 2), uniform(random, -1, 2), height};
            geoidx_surface_point point{};
            REQUIRE(geoidx_closest_point(surface.get(), position.data(), &point, nullptr) == GEOIDX_OK);
            Vector3d at = Vector3d::Zero();
            for (size_t k = 0; k < 3; ++k)
                at += point.weights[k] * soup.positions[soup.triangles[point.triangle][k]];
            CHECK(at.x() == doctest::Approx(std::clamp(position[0], 0.0, 1.0)).epsilon(1e-6));
            CHECK(at.y() == doctest::Approx(std::clamp(position[1], 0.0, 1.0)).epsilon(1e-6));
        }
}

// The normal of a needle may be nothing but rounding.
TEST_CASE("closest point: on a needle it is where it should be") {
    std::mt19937_64 random(6);
    int made_at_all = 0; // the others have no area
    for (int i = 0; i < 3000; ++i) {
        Soup soup;
        const Vector3d along(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
        soup.positions = {Vector3d::Zero(), uniform(random, 0.01, 0.99) * along, along};
        soup.triangles = {{0, 1, 2}};
        const double share = uniform(random, 0, 1);
        const Vector3d position = share * along;
        const geoidx_mesh view = view_of(soup);
        geoidx_surface* made = nullptr;
        if (geoidx_surface_create(&view, nullptr, &made) != GEOIDX_OK) continue;
        ++made_at_all;
        const SurfaceHandle surface(made);
        geoidx_surface_point point{};
        double distance = INFINITY;
        REQUIRE(geoidx_closest_point(surface.get(), position.data(), &point, &distance) == GEOIDX_OK);
        CHECK(distance <= 1e-14 * along.norm());
    }
    CHECK(made_at_all > 1000);
}

TEST_CASE("closest point: an object on ground that is a million times as wide") {
    Soup object = bumpy_sphere(3, 2);
    const uint32_t first = object.vertex_count();
    const Soup alone = object;
    object.positions.insert(object.positions.end(), {{-1e6, -1e6, -9}, {1e6, -1e6, -9}, {1e6, 1e6, -9}});
    object.triangles.insert(object.triangles.begin(), {first, first + 1, first + 2});
    const SurfaceHandle surface = surface_of(object), of_alone = surface_of(alone);
    std::mt19937_64 random(7);
    for (int i = 0; i < 500; ++i) {
        const Vector3d position(uniform(random, -2, 2), uniform(random, -2, 2), uniform(random, -2, 2));
        geoidx_surface_point point{}, same{};
        double distance = 0, expected = 0;
        REQUIRE(geoidx_closest_point(surface.get(), position.data(), &point, &distance) == GEOIDX_OK);
        REQUIRE(geoidx_closest_point(of_alone.get(), position.data(), &same, &expected) == GEOIDX_OK);
        CHECK(distance == expected);
    }
}

TEST_CASE("surface: bad input is refused by name") {
    const Soup soup = cube(1);
    const geoidx_mesh view = view_of(soup);
    geoidx_surface* none = nullptr;
    check_refused(geoidx_surface_create(nullptr, nullptr, &none), GEOIDX_ERROR_INVALID_ARGUMENT,
                  "mesh is NULL");
    check_refused(geoidx_surface_create(&view, nullptr, nullptr), GEOIDX_ERROR_INVALID_ARGUMENT,
                  "out is NULL");
    geoidx_surface_options options;
    geoidx_surface_options_init(&options);
    options.weld_tolerance = -1;
    check_refused(geoidx_surface_create(&view, &options, &none), GEOIDX_ERROR_INVALID_ARGUMENT,
                  "weld_tolerance");
    CHECK(none == nullptr);
    const SurfaceHandle surface = surface_of(soup);
    const std::array<double, 3> at{0, NOT_A_NUMBER, 0}, fine{0, 0, 0};
    geoidx_surface_point point{};
    check_refused(geoidx_closest_point(surface.get(), at.data(), &point, nullptr),
                  GEOIDX_ERROR_INVALID_ARGUMENT, "not finite");
    check_refused(geoidx_closest_point(nullptr, fine.data(), &point, nullptr), GEOIDX_ERROR_INVALID_ARGUMENT,
                  "surface is NULL");
    check_refused(geoidx_closest_point(surface.get(), nullptr, &point, nullptr),
                  GEOIDX_ERROR_INVALID_ARGUMENT, "position is NULL");
    check_refused(geoidx_closest_point(surface.get(), fine.data(), nullptr, nullptr),
                  GEOIDX_ERROR_INVALID_ARGUMENT, "point is NULL");
    geoidx_surface_close(nullptr);
}
