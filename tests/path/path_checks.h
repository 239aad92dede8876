#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "tests/capi/refusals.h"
#include "tests/path/path_cases.h"
#include "tests/support/triangle_distance.h"

// What holds of every path.
namespace geodesic::test {

inline std::vector<geoidx_path_point> points_of(const PathCase& on) {
    uint64_t count = 0;
    REQUIRE(geoidx_query_path_points(on.query.get(), nullptr, 0, &count) == GEOIDX_OK);
    std::vector<geoidx_path_point> points(count);
    REQUIRE(geoidx_query_path_points(on.query.get(), points.data(), count, &count) == GEOIDX_OK);
    return points;
}

// Whether a point lies in a triangle by its weights: at corners of it, as those that lie at one place are.
inline bool is_in_triangle(const Soup& soup, const geoidx_surface_point& point, uint32_t triangle) {
    for (size_t k = 0; k < 3; ++k) {
        const auto is_here = [&](uint32_t corner) {
            return soup.positions[corner] == soup.positions[soup.triangles[point.triangle][k]];
        };
        if (point.weights[k] > 0 && std::ranges::none_of(soup.triangles[triangle], is_here)) return false;
    }
    return true;
}

// That it leads over triangles from one point to the other and is as long as it says: the sum of its pieces,
// each times the cost of its triangle, if there are any.
inline void check_path(const PathCase& on, const geoidx_surface_point& from, const geoidx_surface_point& to,
                       double length, const std::vector<double>& cost = {}) {
    const auto points = points_of(on);
    REQUIRE(points.size() >= 2);
    const auto at = [&](size_t i) {
        return Eigen::Vector3d(points[i].position[0], points[i].position[1], points[i].position[2]);
    };
    constexpr double CLOSE = 1e-9;
    CHECK((at(0) - on.position(from)).norm() < CLOSE);
    CHECK((at(points.size() - 1) - on.position(to)).norm() < CLOSE);
    double sum = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        REQUIRE(points[i].point.triangle < on.soup.triangles.size());
        double weights = 0;
        for (const double weight : points[i].point.weights) {
            CHECK(weight >= 0);
            weights += weight;
        }
        CHECK(weights == doctest::Approx(1).epsilon(1e-12));
        CHECK((on.position(points[i].point) - at(i)).norm() < CLOSE);
        if (i + 1 == points.size()) break;
        const auto& corners = on.soup.triangles[points[i].point.triangle];
        const auto& positions = on.soup.positions;
        CHECK(distance_from_triangle({positions[corners[0]], positions[corners[1]], positions[corners[2]]},
                                     at(i + 1)) < 1e-8);
        CHECK(is_in_triangle(on.soup, points[i + 1].point, points[i].point.triangle));
        sum += (cost.empty() ? 1 : cost[points[i].point.triangle]) * (at(i + 1) - at(i)).norm();
    }
    CHECK(sum == doctest::Approx(length).epsilon(1e-12));
}

inline double path_length(const PathCase& on, const geoidx_surface_point& from,
                          const geoidx_surface_point& to, uint32_t quality,
                          const std::vector<double>& cost = {}) {
    double length = -1;
    require_success(geoidx_query_path(on.query.get(), on.surface.get(), &from, &to, quality, &length));
    check_path(on, from, to, length, cost);
    return length;
}

inline geoidx_surface_point corner(uint32_t triangle, size_t k) {
    geoidx_surface_point point{};
    point.triangle = triangle;
    point.weights[k] = 1;
    return point;
}

}
