#pragma once

#include <array>
#include <vector>

#include "tests/path/path_checks.h"

// Steps to a target.
namespace geodesic::test {

inline constexpr double CLOSE = 1e-9;

struct Step {
    std::array<geoidx_path_point, 2> points;
    double distance = -1;
};

inline Step step_from(const PathCase& on, const geoidx_surface_point& from) {
    Step step;
    require_success(
        geoidx_query_next_step(on.query.get(), on.surface.get(), &from, step.points.data(), &step.distance));
    return step;
}

inline void prepare(const PathCase& on, const geoidx_surface_point& target) {
    require_success(geoidx_query_prepare_target(on.query.get(), on.surface.get(), &target));
}

// That it lies on one triangle, from where it was asked for.
inline double check_step(const PathCase& on, const geoidx_surface_point& from, const Step& step) {
    CHECK(step.points[0].point.triangle == step.points[1].point.triangle);
    CHECK((on.position(from) - on.position(step.points[0].point)).norm() < CLOSE);
    for (const auto& [point, position] : step.points) {
        double weights = 0;
        for (const double weight : point.weights) {
            CHECK(weight >= 0);
            weights += weight;
        }
        CHECK(weights == doctest::Approx(1).epsilon(1e-12));
        CHECK((on.position(point) - Eigen::Vector3d(position[0], position[1], position[2])).norm() < CLOSE);
    }
    return (on.position(step.points[1].point) - on.position(step.points[0].point)).norm();
}

// The length of the whole way, each step times the cost of its triangle, if there are any. Where `share` is
// less than 1, whoever walks asks again before the end of each step.
inline double walk(const PathCase& on, geoidx_surface_point from, const geoidx_surface_point& target,
                   double share = 1, const std::vector<double>& cost = {}) {
    prepare(on, target);
    const size_t most = static_cast<size_t>(static_cast<double>(200 + 20 * on.soup.triangles.size()) / share);
    double length = 0;
    for (size_t steps = 0;; ++steps) {
        REQUIRE(steps < most);
        const Step step = step_from(on, from);
        length += (cost.empty() ? 1 : cost[step.points[0].point.triangle]) * check_step(on, from, step) *
                  (share < 1 && steps % 3 != 2 ? share : 1);
        if (step.distance == 0) break;
        from = step.points[1].point;
        if (share < 1 && steps % 3 != 2)
            for (size_t k = 0; k < 3; ++k)
                from.weights[k] = (1 - share) * step.points[0].point.weights[k] + share * from.weights[k];
    }
    CHECK((on.position(from) - on.position(target)).norm() < CLOSE);
    return length;
}

}
