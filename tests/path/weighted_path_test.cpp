// Paths over surfaces whose triangles cost more or less, compared with closed forms and with the metric.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "tests/path/walks.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

namespace {

// A case whose costs outlive it.
struct WeightedCase {
    WeightedCase(const Soup& soup, std::vector<double> costs, uint32_t engine = GEOIDX_ENGINE_OVERLAY,
                 uint32_t points_per_edge = 12)
        : cost(std::move(costs)), on(soup, options(engine, points_per_edge)) {}

    geoidx_build_options options(uint32_t engine, uint32_t points_per_edge) const {
        geoidx_build_options result = path_options(engine, GEOIDX_METRIC_WEIGHTED);
        result.face_costs = cost.data();
        result.face_cost_count = cost.size();
        result.points_per_edge = points_per_edge;
        return result;
    }
    double length(const geoidx_surface_point& from, const geoidx_surface_point& to, uint32_t quality) const {
        return path_length(on, from, to, quality, cost);
    }

    std::vector<double> cost; // per triangle
    PathCase on;
};

std::vector<double> random_costs(const Soup& soup, std::mt19937_64& random, double dearest) {
    std::vector<double> costs(soup.triangles.size());
    for (double& cost : costs) cost = uniform(random, 1, dearest);
    return costs;
}

// The middle of a triangle decides.
template <class CostAt>
std::vector<double> costs_by_place(const Soup& soup, const CostAt& cost_at) {
    std::vector<double> costs;
    for (const auto& [a, b, c] : soup.triangles)
        costs.push_back(cost_at((soup.positions[a] + soup.positions[b] + soup.positions[c]) / 3));
    return costs;
}

// A point of a flat mesh of the plane z = 0.
geoidx_surface_point point_of(const PathCase& on, double x, double y) {
    const std::array<double, 3> position{x, y, 0};
    geoidx_surface_point point{};
    double distance = 1;
    REQUIRE(geoidx_closest_point(on.surface.get(), position.data(), &point, &distance) == GEOIDX_OK);
    REQUIRE(distance < 1e-12);
    for (double& weight : point.weights) weight = std::max(weight, 0.0);
    return point;
}

// How much longer than the path its neighbour among the ways over evenly spaced points can be.
double rounding_to_points(const WeightedCase& of, uint32_t points_per_edge) {
    double sum = 0;
    for (const auto& [point, position] : points_of(of.on)) {
        double longest = 0;
        const auto& corners = of.on.soup.triangles[point.triangle];
        for (size_t k = 0; k < 3; ++k)
            longest = std::max(
                longest,
                (of.on.soup.positions[corners[k]] - of.on.soup.positions[corners[(k + 1) % 3]]).norm());
        sum += of.cost[point.triangle] * longest / (points_per_edge + 1);
    }
    return sum;
}

// That paths are ways over the surface, hardly longer than those over the points of the metric.
void check_paths_of(const WeightedCase& of, size_t count, uint32_t points_per_edge, double straight_error,
                    double exact_error) {
    std::mt19937_64 random(3);
    for (size_t i = 0; i < count; ++i) {
        const auto from = random_point(of.on.soup, random, i), to = random_point(of.on.soup, random, i / 4);
        const double solved = of.on.exact(from, to);
        CAPTURE(i);
        CAPTURE(solved);
        if (solved == INFINITE) {
            double length = 0;
            check_refused(geoidx_query_path(of.on.query.get(), of.on.surface.get(), &from, &to,
                                            GEOIDX_PATH_STRAIGHT, &length),
                          GEOIDX_ERROR_NO_PATH, "component");
            continue;
        }
        const double straight = of.length(from, to, GEOIDX_PATH_STRAIGHT);
        CHECK(straight + rounding_to_points(of, points_per_edge) >= solved * (1 - 1e-9));
        CHECK(straight <= solved * (1 + straight_error) + 1e-9);
        const double exact = of.length(from, to, GEOIDX_PATH_EXACT);
        CHECK(exact <= straight * (1 + 1e-9));
        CHECK(exact <= solved * (1 + exact_error) + 1e-9);
        CHECK(exact + rounding_to_points(of, points_per_edge) >= solved * (1 - 1e-9));
    }
}

double least(double low, double high, const auto& value) {
    for (int i = 0; i < 200; ++i) {
        const double third = (high - low) / 3;
        if (value(low + third) < value(high - third))
            high -= third;
        else
            low += third;
    }
    return value(low);
}

}

TEST_CASE("weighted path: where all costs are the same it is the straight line times the cost" *
          doctest::skip(SANITIZED)) {
    std::mt19937_64 random(2);
    for (const Soup& soup : {jittered_grid(9, 4), delaunay_square(60, 3), grid(7, 5, 1, 1)})
        for (const uint32_t engine : {GEOIDX_ENGINE_OVERLAY, GEOIDX_ENGINE_GRAPH}) {
            const WeightedCase of(soup, std::vector<double>(soup.triangles.size(), 2.5), engine);
            for (size_t i = 0; i < 30; ++i) {
                const auto from = random_point(soup, random, i), to = random_point(soup, random, i / 4);
                const double line = 2.5 * (of.on.position(from) - of.on.position(to)).norm();
                for (const uint32_t quality : {GEOIDX_PATH_STRAIGHT, GEOIDX_PATH_EXACT})
                    CHECK(of.length(from, to, quality) == doctest::Approx(line).epsilon(1e-7));
            }
        }
}

TEST_CASE("weighted path: where all costs are the same it is hardly longer than the exact path" *
          doctest::skip(SANITIZED)) {
    for (const Soup& soup : path_soups()) {
        const WeightedCase of(soup, std::vector<double>(soup.triangles.size(), 0.25));
        const PathCase by_length(soup);
        std::mt19937_64 random(7);
        for (size_t i = 0; i < 20; ++i) {
            const auto from = random_point(soup, random, i), to = random_point(soup, random, i / 4);
            const double exact = by_length.exact(from, to) / 4;
            if (exact == INFINITE) continue;
            const double length = of.length(from, to, GEOIDX_PATH_EXACT);
            CHECK(length >= exact * (1 - 1e-9) - 1e-9);
            CHECK(length <= exact * (1 + 1e-3) + 1e-9);
        }
    }
}

TEST_CASE("weighted path: bends by Snell's law between two half planes" * doctest::skip(SANITIZED)) {
    const Soup soup = grid(8, 8, 1, 1);
    const auto cost_at = [](const Eigen::Vector3d& at) { return at.x() < 0.5 ? 1.0 : 2.5; };
    const auto tiny_cost_at = [&](const Eigen::Vector3d& at) { return 1e-13 * cost_at(at); };
    const WeightedCase of(soup, costs_by_place(soup, cost_at)),
        of_tiny(soup, costs_by_place(soup, tiny_cost_at));
    std::mt19937_64 random(4);
    for (size_t i = 0; i < 40; ++i) {
        const double x1 = uniform(random, 0.02, 0.48), y1 = uniform(random, 0.2, 0.8);
        const double x2 = uniform(random, 0.52, 0.98), y2 = uniform(random, 0.2, 0.8);
        const double best = least(0, 1, [&](double y) {
            return std::hypot(0.5 - x1, y - y1) + 2.5 * std::hypot(x2 - 0.5, y2 - y);
        });
        const auto from = point_of(of.on, x1, y1), to = point_of(of.on, x2, y2);
        for (const uint32_t quality : {GEOIDX_PATH_STRAIGHT, GEOIDX_PATH_EXACT}) {
            CHECK(of.length(from, to, quality) == doctest::Approx(best).epsilon(1e-7));
            CHECK(of.length(to, from, quality) == doctest::Approx(best).epsilon(1e-7));
            CHECK(1e13 * of_tiny.length(from, to, quality) == doctest::Approx(best).epsilon(1e-7));
        }
    }
}

// From the dear side to the dear side the cheap one is met at the critical angle, and left at it.
TEST_CASE("weighted path: leads along the edge of a cheaper half plane") {
    const Soup soup = grid(8, 8, 1, 1);
    constexpr double DEAR = 2;
    const WeightedCase of(
        soup, costs_by_place(soup, [](const Eigen::Vector3d& at) { return at.x() < 0.5 ? 1.0 : DEAR; }));
    const double sine = 1 / DEAR, cosine = std::sqrt(1 - sine * sine);
    for (const double x1 : {0.55, 0.6, 0.66})
        for (const double x2 : {0.53, 0.58, 0.64}) {
            const double off = x1 + x2 - 1, along = 0.8;
            REQUIRE(along > off * sine / cosine);
            const double best = DEAR * off * cosine + along;
            const auto from = point_of(of.on, x1, 0.1), to = point_of(of.on, x2, 0.9);
            for (const uint32_t quality : {GEOIDX_PATH_STRAIGHT, GEOIDX_PATH_EXACT})
                CHECK(of.length(from, to, quality) == doctest::Approx(best).epsilon(1e-6));
        }
}

// A row of cheap triangles is a road: a way along its side costs what the road does.
TEST_CASE("weighted path: follows a cheap road" * doctest::skip(SANITIZED)) {
    const Soup soup = grid(12, 12, 1, 1);
    const auto on_road = [](const Eigen::Vector3d& at) { return at.y() > 1.0 / 12 && at.y() < 2.0 / 12; };
    const WeightedCase of(soup,
                          costs_by_place(soup, [&](const auto& at) { return on_road(at) ? 1.0 : 20.0; }));
    const double from_side = 2.0 / 12, height = 0.5, sine = 1.0 / 20;
    const double off = height - from_side, width = 0.9;
    const double best = 2 * 20 * off * std::sqrt(1 - sine * sine) + width;
    const auto from = point_of(of.on, 0.05, height), to = point_of(of.on, 0.95, height);
    REQUIRE(best < 20 * width);
    for (const uint32_t quality : {GEOIDX_PATH_STRAIGHT, GEOIDX_PATH_EXACT})
        CHECK(of.length(from, to, quality) == doctest::Approx(best).epsilon(1e-6));
}

TEST_CASE("weighted path: hardly longer than the metric's distances, by random costs" *
          doctest::skip(SANITIZED)) {
    std::mt19937_64 random(9);
    size_t number = 0;
    for (const Soup& soup : path_soups()) {
        ++number;
        CAPTURE(number);
        for (const double dearest : {1.5, 4.0, 30.0}) {
            CAPTURE(dearest);
            check_paths_of(WeightedCase(soup, random_costs(soup, random, dearest)), 12, 12, 0.1, 1e-6);
        }
    }
}

TEST_CASE("weighted path: by the graph engine, too" * doctest::skip(SANITIZED)) {
    std::mt19937_64 random(10);
    const Soup soup = joined(torus(12, 8, 1, 0.4), comb(1));
    check_paths_of(WeightedCase(soup, random_costs(soup, random, 5), GEOIDX_ENGINE_GRAPH), 24, 12, 0.1, 1e-6);
}

TEST_CASE("weighted path: where the metric has other points on each edge, or none" *
          doctest::skip(SANITIZED)) {
    std::mt19937_64 random(12);
    const Soup soup = bumpy_sphere(2, 5);
    const auto costs = random_costs(soup, random, 5);
    for (const uint32_t points : {0u, 3u, 30u})
        check_paths_of(WeightedCase(soup, costs, GEOIDX_ENGINE_OVERLAY, points), 12, points, 0.1, 1e-6);
}

TEST_CASE("weighted path: on stress meshes" * doctest::skip(SANITIZED)) {
    std::mt19937_64 random(11);
    for (const auto& families : {stress_families(), unorientable_families()})
        for (const StressFamily& family : families) {
            CAPTURE(std::string(family.name));
            const Soup soup = family.draw(random);
            check_paths_of(WeightedCase(soup, random_costs(soup, random, 6)), 6, 12, 0.1, 1e-5);
        }
}

TEST_CASE("weighted path: on random triangles between a few points") {
    for (uint64_t seed = 0; seed < 60; ++seed) {
        CAPTURE(seed);
        std::mt19937_64 random(seed);
        const Soup soup = random_soup(random, 7 + seed % 6, 4 + seed % 9);
        auto costs = random_costs(soup, random, 8);
        std::map<std::array<uint32_t, 3>, double> cheapest; // of triangles that are there twice
        const auto key = [&](size_t t) {
            auto corners = soup.triangles[t];
            std::ranges::sort(corners);
            return corners;
        };
        for (size_t t = 0; t < costs.size(); ++t) {
            const auto [found, is_new] = cheapest.try_emplace(key(t), costs[t]);
            found->second = std::min(found->second, costs[t]);
        }
        WeightedCase of(soup, costs);
        for (size_t t = 0; t < costs.size(); ++t) of.cost[t] = cheapest[key(t)];
        check_paths_of(of, 6, 12, 0.1, 1e-5);
    }
}

TEST_CASE("weighted path: from a point to itself, and to another one of its triangle") {
    std::mt19937_64 random(5);
    const Soup soup = torus(10, 8, 1, 0.4);
    const WeightedCase of(soup, random_costs(soup, random, 1.2));
    for (size_t i = 0; i < 8; ++i) {
        const auto from = random_point(soup, random, i);
        for (const uint32_t quality : {GEOIDX_PATH_STRAIGHT, GEOIDX_PATH_EXACT}) {
            CHECK(of.length(from, from, quality) == 0);
            auto to = random_point(soup, random, 0);
            to.triangle = from.triangle;
            CHECK(of.length(from, to, quality) <=
                  of.cost[from.triangle] * (of.on.position(from) - of.on.position(to)).norm() * (1 + 1e-12));
        }
    }
}

TEST_CASE("weighted path: steps lead along it to the target") {
    std::mt19937_64 random(6);
    for (const uint32_t engine : {GEOIDX_ENGINE_OVERLAY, GEOIDX_ENGINE_GRAPH})
        for (const Soup& soup : {bumpy_sphere(2, 9), pinched_sheets(2), comb(1)}) {
            const WeightedCase of(soup, random_costs(soup, random, 5), engine);
            for (size_t i = 0; i < 16; ++i) {
                const auto from = random_point(soup, random, i), to = random_point(soup, random, i / 4);
                const double length = of.length(from, to, GEOIDX_PATH_STRAIGHT);
                for (const double share : {1.0, 0.6})
                    CHECK(walk(of.on, from, to, share, of.cost) == doctest::Approx(length).epsilon(1e-9));
            }
        }
}

// Their paths pass very near to vertices, and through several points at one place.
TEST_CASE("weighted path: steps on long triangles and through ones without area end at the target" *
          doctest::skip(SANITIZED)) {
    std::mt19937_64 random(2);
    for (const Soup& soup : {split_edges(10), prism(64, 1, 100)})
        for (size_t of_costs = 0; of_costs < 4; ++of_costs) {
            const WeightedCase of(soup, random_costs(soup, random, 100), GEOIDX_ENGINE_OVERLAY);
            for (size_t i = 0; i < 200; ++i) {
                const auto from = random_point(soup, random, i), to = random_point(soup, random, i / 4);
                walk(of.on, from, to, 1, of.cost);
            }
        }
}

TEST_CASE("weighted path: a surface needs the costs of the index") {
    std::mt19937_64 random(6);
    const Soup soup = torus(10, 8, 1, 0.4);
    const WeightedCase of(soup, random_costs(soup, random, 5));
    const geoidx_mesh view = view_of(soup);
    const auto from = corner(0, 0), to = corner(50, 1);
    const auto check_by = [&](const geoidx_surface_options* options, const char* detail) {
        geoidx_surface* made = nullptr;
        REQUIRE(geoidx_surface_create(&view, options, &made) == GEOIDX_OK);
        const SurfaceHandle surface(made);
        double length = 0;
        check_refused(geoidx_query_path(of.on.query.get(), made, &from, &to, GEOIDX_PATH_STRAIGHT, &length),
                      GEOIDX_ERROR_INVALID_ARGUMENT, detail);
        check_refused(geoidx_query_prepare_target(of.on.query.get(), made, &to),
                      GEOIDX_ERROR_INVALID_ARGUMENT, detail);
    };
    check_by(nullptr, "face_costs");
    auto options = surface_options(of.options(GEOIDX_ENGINE_OVERLAY, 13));
    check_by(&options, "points_per_edge");
    auto other = of.cost;
    other[3] *= 2;
    options.points_per_edge = 12;
    options.face_costs = other.data();
    check_by(&options, "face_costs");
}

TEST_CASE("weighted path: over the mesh that the index keeps, by the same costs" * doctest::skip(SANITIZED)) {
    std::mt19937_64 random(8);
    const Soup soup = bumpy_sphere(2, 5);
    const std::vector<double> costs = random_costs(soup, random, 4);
    const WeightedCase of(soup, costs);
    geoidx_build_options options = of.options(GEOIDX_ENGINE_OVERLAY, 12);
    options.store_mesh = 1;
    const geoidx_mesh view = view_of(soup);
    geoidx* built = nullptr;
    require_success(geoidx_build(&view, &options, &built));
    const IndexHandle index(built);
    const geoidx_surface_options of_surface = surface_options(options);
    geoidx_surface *bare = nullptr, *with_costs = nullptr;
    require_success(geoidx_surface_of_index(built, nullptr, &bare));
    require_success(geoidx_surface_of_index(built, &of_surface, &with_costs));
    const SurfaceHandle without(bare), surface(with_costs);
    for (size_t i = 0; i < 10; ++i) {
        const auto from = random_point(soup, random, i), to = random_point(soup, random, i / 4);
        double length = -1;
        check_refused(geoidx_query_path(of.on.query.get(), bare, &from, &to, GEOIDX_PATH_STRAIGHT, &length),
                      GEOIDX_ERROR_INVALID_ARGUMENT, "face_costs");
        require_success(
            geoidx_query_path(of.on.query.get(), with_costs, &from, &to, GEOIDX_PATH_STRAIGHT, &length));
        CHECK(length == of.length(from, to, GEOIDX_PATH_STRAIGHT));
    }
    const std::vector<double> too_few(costs.begin(), costs.end() - 1);
    geoidx_surface_options wrong = of_surface;
    wrong.face_costs = too_few.data();
    wrong.face_cost_count = too_few.size();
    geoidx_surface* none = nullptr;
    check_refused(geoidx_surface_of_index(built, &wrong, &none), GEOIDX_ERROR_INVALID_ARGUMENT, "face_cost");
}

TEST_CASE("weighted path: not where lengths of edges are given") {
    const Soup soup = torus(10, 8, 1, 0.4);
    std::vector<double> lengths;
    for (const auto& corners : soup.triangles)
        for (size_t k = 0; k < 3; ++k)
            lengths.push_back(
                (soup.positions[corners[(k + 1) % 3]] - soup.positions[corners[(k + 2) % 3]]).norm());
    const std::vector<double> costs(soup.triangles.size(), 2);
    for (const uint32_t metric : {GEOIDX_METRIC_EXACT, GEOIDX_METRIC_WEIGHTED}) {
        auto options = path_options(GEOIDX_ENGINE_OVERLAY, metric);
        options.edge_lengths = lengths.data();
        options.edge_length_count = lengths.size();
        if (metric == GEOIDX_METRIC_WEIGHTED) {
            options.face_costs = costs.data();
            options.face_cost_count = costs.size();
        }
        const PathCase on(soup, options);
        const auto from = corner(0, 0), to = corner(50, 1);
        double length = 0;
        check_refused(
            geoidx_query_path(on.query.get(), on.surface.get(), &from, &to, GEOIDX_PATH_STRAIGHT, &length),
            GEOIDX_ERROR_INVALID_ARGUMENT, "edge_lengths");
    }
}

TEST_CASE("weighted path: costs that a surface cannot have are refused by name") {
    const Soup soup = grid(3, 3, 1, 1);
    const geoidx_mesh view = view_of(soup);
    const std::vector<double> costs(soup.triangles.size(), 2);
    const std::array<uint32_t, 2> no_edge{0, 15}, edge{0, 1};
    const double fine = 1, negative = -1;
    const auto refused = [&](const char* detail, const auto& change) {
        geoidx_surface_options options;
        geoidx_surface_options_init(&options);
        CHECK(options.points_per_edge == 12);
        change(options);
        geoidx_surface* surface = nullptr;
        check_refused(geoidx_surface_create(&view, &options, &surface), GEOIDX_ERROR_INVALID_ARGUMENT,
                      detail);
        CHECK(surface == nullptr);
    };
    refused("face_costs is NULL", [&](auto& options) { options.face_cost_count = costs.size(); });
    refused("18 triangles", [&](auto& options) {
        options.face_costs = costs.data();
        options.face_cost_count = costs.size() - 1;
    });
    refused("points_per_edge", [&](auto& options) {
        options.face_costs = costs.data();
        options.face_cost_count = costs.size();
        options.points_per_edge = 1001;
    });
    refused("edge_cost_count", [&](auto& options) { options.edge_cost_count = 1; });
    const auto with_edge = [](auto& options, const auto& vertices, const double& cost) {
        options.edge_cost_count = 1;
        options.edge_cost_vertices = vertices.data();
        options.edge_costs = &cost;
    };
    refused("no edge of the mesh", [&](auto& options) { with_edge(options, no_edge, fine); });
    refused("has the cost", [&](auto& options) { with_edge(options, edge, negative); });
}
