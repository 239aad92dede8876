#include "tests/campaign/path_checks.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace geodesic::campaign {

namespace {

// Paths and positions are doubles; a tolerance of the weights of points and of faces that are needles.
constexpr double POSITION_ROUNDING = 1e-9;
// The lengths of two paths that are the same, and of the sum of a path's pieces.
constexpr double LENGTH_ROUNDING = 1e-6;
// How much longer than the shortest a path may be that is led by the tables of an index: by costs, or by
// GEOIDX_ENGINE_GRAPH, gross errors only. Over the surface, paths of GEOIDX_PATH_EXACT are the shortest, and
// those of GEOIDX_PATH_STRAIGHT are led by tables that are right to some percent.
constexpr double PATH_LONG = 2, STRAIGHT_LONG = 1.1;

Eigen::Vector3d position_of(const geoidx_path_point& point) {
    return {point.position[0], point.position[1], point.position[2]};
}

class PathChecks {
public:
    PathChecks(const Subject& subject, const SurfacePoints& points, geoidx_solver* solver)
        : subject_(subject), input_(subject.input()), solver_(solver), points_(points),
          rounding_(POSITION_ROUNDING * points_.extent()) {}

    void check(Dice& dice) {
        constexpr int PAIRS = 6;
        for (int i = 0; i < PAIRS; ++i) {
            const bool at_vertices = input_.has_paths_of_vertices_only() || dice.chance(0.2);
            const auto a = points_.random_point(dice, at_vertices);
            const auto b = dice.chance(0.05) ? a : points_.random_point(dice, at_vertices);
            check_pair(a, b);
        }
    }

private:
    void check_pair(const geoidx_surface_point& a, const geoidx_surface_point& b) {
        const bool is_joined = points_.are_joined(a, b);
        at_ = described(a) + " to " + described(b);
        double lengths[2]{-1, -1};
        for (const uint32_t quality : {GEOIDX_PATH_STRAIGHT, GEOIDX_PATH_EXACT}) {
            const geoidx_status status =
                geoidx_query_path(subject_.query(), points_.surface(), &a, &b, quality, &lengths[quality]);
            if (is_joined && status == GEOIDX_ERROR_NO_PATH && input_.has_own_distances()) return;
            expect(status == (is_joined ? GEOIDX_OK : GEOIDX_ERROR_NO_PATH), "path status", "%d %s, %s",
                   status, at_.c_str(), geoidx_last_error());
            if (is_joined) check_points_of_path(a, b, lengths[quality]);
        }
        if (!is_joined) return expect_no_walk(a, b);
        check_lengths(a, b, lengths);
        check_walk(a, b, lengths[GEOIDX_PATH_STRAIGHT]);
    }

    std::vector<geoidx_path_point> points_of_path() const {
        uint64_t count = 0;
        succeed(geoidx_query_path_points(subject_.query(), nullptr, 0, &count),
                "geoidx_query_path_points, count");
        std::vector<geoidx_path_point> points(count);
        succeed(geoidx_query_path_points(subject_.query(), points.data(), count, &count),
                "geoidx_query_path_points");
        return points;
    }

    void check_points_of_path(const geoidx_surface_point& a, const geoidx_surface_point& b,
                              double length) const {
        const auto path = points_of_path();
        expect(path.size() >= 2, "a path has two points", "%zu %s", path.size(), at_.c_str());
        expect_at("path begins", path.front(), points_.position(a));
        expect_at("path ends", path.back(), points_.position(b));
        double sum = 0;
        for (size_t i = 0; i < path.size(); ++i) {
            check_point(path[i]);
            if (i + 1 < path.size()) sum += check_piece(path[i], path[i + 1]);
        }
        if (input_.has_costs_by_length()) expect_same_length("path is the sum of its pieces", sum, length);
    }

    void expect_at(const char* check, const geoidx_path_point& point, const Eigen::Vector3d& at) const {
        const double off = (position_of(point) - at).norm();
        expect(off <= rounding_, check, "%g off, %s", off, at_.c_str());
    }
    void expect_same_length(const char* check, double a, double b) const {
        expect(std::abs(a - b) <= LENGTH_ROUNDING * b + rounding_, check, "%.17g, %.17g %s", a, b,
               at_.c_str());
    }

    void check_point(const geoidx_path_point& point) const {
        expect(point.point.triangle < input_.mesh().triangle_count, "path triangle", "%u %s",
               point.point.triangle, at_.c_str());
        double sum = 0;
        for (const double weight : point.point.weights) {
            expect(weight >= 0, "path weights", "%g %s", weight, at_.c_str());
            sum += weight;
        }
        expect(std::abs(sum - 1) < 1e-9, "path weights in sum", "%.17g %s", sum, at_.c_str());
        expect_at("path position", point, points_.position(point.point));
    }

    // Returns what the piece costs.
    double check_piece(const geoidx_path_point& from, const geoidx_path_point& to) const {
        const uint32_t triangle = from.point.triangle;
        const double off = points_.distance_from_triangle(triangle, position_of(to));
        expect(off <= rounding_, "path piece on its triangle", "%g off %u, %s", off, triangle, at_.c_str());
        expect(points_.has_point(triangle, to.point), "path points share a triangle", "%s on %u, %s",
               described(to.point).c_str(), triangle, at_.c_str());
        return points_.cost_of_piece(from.point, to.point) * (position_of(to) - position_of(from)).norm();
    }

    void check_lengths(const geoidx_surface_point& a, const geoidx_surface_point& b, const double* lengths) {
        const double straight = lengths[GEOIDX_PATH_STRAIGHT], exact = lengths[GEOIDX_PATH_EXACT];
        expect(straight >= 0 && exact >= 0 && straight < FAR && exact < FAR, "path lengths", "%g, %g %s",
               straight, exact, at_.c_str());
        expect(exact <= straight * (1 + LENGTH_ROUNDING) + rounding_, "exact is no longer than straight",
               "%.17g, straight %.17g %s", exact, straight, at_.c_str());
        if (input_.has_own_distances()) return;
        const double along = points_.along_edges(a, b);
        expect(straight <= PATH_LONG * subject_.bounds().most(along) + rounding_, "path over edges",
               "%.17g, edges %.17g %s", straight, along, at_.c_str());
        if (input_.options().metric == GEOIDX_METRIC_EDGES) {
            expect(exact >= along * (1 - LENGTH_ROUNDING) - rounding_, "path under edges",
                   "%.17g, edges %.17g %s", exact, along, at_.c_str());
            return;
        }
        double metric = -1;
        succeed(geoidx_solver_point_distances(solver_, &a, 1, &b, 1, &metric),
                "geoidx_solver_point_distances");
        const bool is_exact = input_.options().metric == GEOIDX_METRIC_EXACT;
        const bool is_led_well =
            is_exact && input_.options().engine == GEOIDX_ENGINE_OVERLAY && input_.options().delta == 0;
        if (is_exact)
            expect(exact >= metric * (1 - LENGTH_ROUNDING) - rounding_, "path under the metric",
                   "%.17g, metric %.17g %s", exact, metric, at_.c_str());
        expect(exact <= metric * (is_led_well ? 1 + LENGTH_ROUNDING : PATH_LONG) + rounding_,
               "path over the metric", "%.17g, metric %.17g %s", exact, metric, at_.c_str());
        expect(straight <= metric * (is_led_well ? STRAIGHT_LONG : PATH_LONG) + rounding_,
               "straight path over the metric", "%.17g, metric %.17g %s", straight, metric, at_.c_str());
    }

    void expect_no_walk(const geoidx_surface_point& a, const geoidx_surface_point& b) {
        succeed(geoidx_query_prepare_target(subject_.query(), points_.surface(), &b),
                "geoidx_query_prepare_target");
        std::array<geoidx_path_point, 2> step;
        const geoidx_status status =
            geoidx_query_next_step(subject_.query(), points_.surface(), &a, step.data(), nullptr);
        expect(status == GEOIDX_ERROR_NO_PATH, "step to another component", "%d %s", status, at_.c_str());
    }

    void check_walk(const geoidx_surface_point& a, const geoidx_surface_point& b, double straight) {
        succeed(geoidx_query_prepare_target(subject_.query(), points_.surface(), &b),
                "geoidx_query_prepare_target");
        const size_t most = 4 * input_.mesh().triangle_count + 8;
        geoidx_surface_point from = a;
        double sum = 0, distance = 0;
        for (size_t steps = 0;; ++steps) {
            expect(steps < most, "walk ends", "%.17g so far, %.17g to go %s", sum, distance, at_.c_str());
            std::array<geoidx_path_point, 2> step;
            succeed(
                geoidx_query_next_step(subject_.query(), points_.surface(), &from, step.data(), &distance),
                "geoidx_query_next_step");
            for (const auto& point : step) check_point(point);
            expect_at("step begins", step[0], points_.position(from));
            sum += check_piece(step[0], step[1]);
            if (distance == 0 && is_same(step[0].point, step[1].point)) break;
            from = step[1].point;
        }
        expect((points_.position(from) - points_.position(b)).norm() <= rounding_, "walk arrives", "%s",
               at_.c_str());
        if (input_.has_costs_by_length())
            expect(sum <= straight * (1 + 0.01) + rounding_, "walk is a straight path", "%.17g, %.17g %s",
                   sum, straight, at_.c_str());
    }

    const Subject& subject_;
    const BuildInput& input_;
    geoidx_solver* solver_;
    const SurfacePoints& points_;
    const double rounding_;
    std::string at_; // the pair that is looked at
};

}

void check_paths(const Subject& subject, const SurfacePoints& points, geoidx_solver* solver, Dice& dice) {
    if (subject.input().options().edge_lengths) return;
    PathChecks(subject, points, solver).check(dice);
}

}
