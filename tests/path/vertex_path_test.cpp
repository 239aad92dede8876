// Paths over vertices by metrics that know nothing of what lies between: costs of edges, and the caller's
// own.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "tests/path/walks.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

namespace {

// Costs of every edge of a soup whose vertices all differ in position.
struct EdgeCosts {
    EdgeCosts(const Soup& soup, std::mt19937_64& random) {
        std::map<std::pair<uint32_t, uint32_t>, double> known;
        for (const auto& corners : soup.triangles)
            for (size_t k = 0; k < 3; ++k) {
                const auto edge = std::minmax(corners[k], corners[(k + 1) % 3]);
                known.try_emplace({edge.first, edge.second}, random() % 8 == 0 ? 0 : uniform(random, 0.1, 5));
            }
        arcs.resize(soup.positions.size());
        for (const auto& [edge, cost] : known) {
            vertices.insert(vertices.end(), {edge.second, edge.first});
            costs.push_back(cost);
            arcs[edge.first][edge.second] = arcs[edge.second][edge.first] = cost;
        }
    }

    geoidx_build_options options(uint32_t engine) const {
        geoidx_build_options result = path_options(engine, GEOIDX_METRIC_EDGES);
        result.edge_cost_count = static_cast<uint32_t>(costs.size());
        result.edge_cost_vertices = vertices.data();
        result.edge_costs = costs.data();
        return result;
    }

    // Of each vertex from one of them: no vertex is nearer than over one of its neighbours.
    std::vector<double> distances(uint32_t source) const {
        std::vector<double> result(arcs.size(), INFINITE);
        result[source] = 0;
        for (bool has_changed = true; has_changed;) {
            has_changed = false;
            for (uint32_t v = 0; v < arcs.size(); ++v)
                for (const auto& [other, cost] : arcs[v])
                    if (result[other] + cost < result[v]) {
                        result[v] = result[other] + cost;
                        has_changed = true;
                    }
        }
        return result;
    }

    std::vector<uint32_t> vertices;
    std::vector<double> costs;
    std::vector<std::map<uint32_t, double>> arcs; // per vertex
};

uint32_t id_of(const PathCase& on, const geoidx_surface_point& point) {
    const auto* const heaviest = std::ranges::max_element(point.weights);
    REQUIRE(*heaviest == 1);
    return on.soup.triangles[point.triangle][static_cast<size_t>(heaviest - point.weights)];
}

std::vector<uint32_t> ids_of_path(const PathCase& on) {
    std::vector<uint32_t> ids;
    const auto points = points_of(on);
    for (const auto& [point, position] : points) {
        ids.push_back(id_of(on, point));
        CHECK((on.position(point) - Eigen::Vector3d(position[0], position[1], position[2])).norm() == 0);
    }
    for (size_t i = 0; i + 1 < ids.size(); ++i) // they share the triangle of the first
        CHECK(std::ranges::count(on.soup.triangles[points[i].point.triangle], ids[i + 1]) == 1);
    return ids;
}

geoidx_status ask_path(const PathCase& on, const geoidx_surface_point& from, const geoidx_surface_point& to,
                       double& length) {
    return geoidx_query_path(on.query.get(), on.surface.get(), &from, &to, GEOIDX_PATH_STRAIGHT, &length);
}

// The cost of the steps of whoever follows them.
template <class Cost>
double walked(const PathCase& on, geoidx_surface_point from, const geoidx_surface_point& target,
              const Cost& cost) {
    prepare(on, target);
    double length = 0;
    for (size_t steps = 0;; ++steps) {
        REQUIRE(steps < on.soup.positions.size() + 2);
        const Step step = step_from(on, from);
        check_step(on, from, step);
        const uint32_t a = id_of(on, step.points[0].point), b = id_of(on, step.points[1].point);
        if (a != b) length += cost(a, b);
        if (step.distance == 0 && b == id_of(on, target)) return length;
        from = step.points[1].point;
    }
}

void check_edge_costs(const Soup& soup, uint32_t engine, std::mt19937_64& random, double error) {
    const EdgeCosts costs(soup, random);
    const PathCase on(soup, costs.options(engine));
    for (size_t i = 0; i < 12; ++i) {
        CAPTURE(i);
        const auto from = random_point(soup, random, 3), to = random_point(soup, random, 3);
        const uint32_t source = id_of(on, from), target = id_of(on, to);
        const double least = costs.distances(source)[target];
        double length = -1;
        if (least == INFINITE) {
            check_refused(ask_path(on, from, to, length), GEOIDX_ERROR_NO_PATH, "component");
            continue;
        }
        require_success(ask_path(on, from, to, length));
        const auto ids = ids_of_path(on);
        CHECK(ids.front() == source);
        CHECK(ids.back() == target);
        double sum = 0;
        for (size_t k = 0; k + 1 < ids.size(); ++k)
            if (ids[k] != ids[k + 1]) sum += costs.arcs[ids[k]].at(ids[k + 1]);
        CHECK(sum == doctest::Approx(length).epsilon(1e-12));
        CHECK(length >= least * (1 - 1e-12));
        CHECK(length <= least * (1 + error) + 1e-9);
        const double steps =
            walked(on, from, to, [&](uint32_t a, uint32_t b) { return costs.arcs[a].at(b); });
        CHECK(steps == doctest::Approx(length).epsilon(1e-12));
    }
}

// Straight through space, between all vertices of the case.
struct StraightMetric {
    const Soup& soup;

    static geoidx_status call(void* user, uint32_t source, const uint32_t* targets, uint32_t count,
                              double* distances) {
        const Soup& soup = static_cast<const StraightMetric*>(user)->soup;
        for (uint32_t i = 0; i < count; ++i)
            distances[i] = (soup.positions[source] - soup.positions[targets[i]]).norm();
        return GEOIDX_OK;
    }
};

// The costs of edges as a callback, so that the library does not know what they are.
struct HiddenCosts {
    std::vector<std::vector<double>> distances;

    static geoidx_status call(void* user, uint32_t source, const uint32_t* targets, uint32_t count,
                              double* distances) {
        const auto& row = static_cast<const HiddenCosts*>(user)->distances[source];
        for (uint32_t i = 0; i < count; ++i) distances[i] = row[targets[i]];
        return GEOIDX_OK;
    }
};

geoidx_build_options callback_options(uint32_t engine, geoidx_metric_fn function, void* user) {
    geoidx_build_options options = path_options(engine, GEOIDX_METRIC_CALLBACK);
    options.metric_callback = function;
    options.metric_user = user;
    return options;
}

double index_distance(const PathCase& on, uint32_t a, uint32_t b) {
    float distance = 0;
    REQUIRE(geoidx_query_sssd(on.query.get(), a, b, &distance) == GEOIDX_OK);
    return double{distance};
}

// Over vertices, none twice, and as long as the index says that the steps are.
std::vector<uint32_t> check_callback_path(const PathCase& on, const geoidx_surface_point& from,
                                          const geoidx_surface_point& to, double& length) {
    require_success(ask_path(on, from, to, length));
    const auto ids = ids_of_path(on);
    CHECK(ids.front() == id_of(on, from));
    CHECK(ids.back() == id_of(on, to));
    double sum = 0;
    for (size_t k = 0; k + 1 < ids.size(); ++k)
        if (ids[k] != ids[k + 1]) sum += index_distance(on, ids[k], ids[k + 1]);
    CHECK(sum == doctest::Approx(length).epsilon(1e-12));
    if (ids.front() != ids.back()) CHECK(std::set(ids.begin(), ids.end()).size() == ids.size());
    const double steps =
        walked(on, from, to, [&](uint32_t a, uint32_t b) { return index_distance(on, a, b); });
    CHECK(steps == doctest::Approx(length).epsilon(1e-12));
    return ids;
}

constexpr uint32_t ENGINES[] = {GEOIDX_ENGINE_OVERLAY, GEOIDX_ENGINE_GRAPH};

}

TEST_CASE("vertex path: the cheapest by costs of edges") {
    std::mt19937_64 random(1);
    size_t number = 0;
    for (const Soup& soup : path_soups()) {
        ++number;
        CAPTURE(number);
        check_edge_costs(soup, GEOIDX_ENGINE_GRAPH, random, 1e-5);
        check_edge_costs(soup, GEOIDX_ENGINE_OVERLAY, random, 0.02);
    }
}

TEST_CASE("vertex path: by costs of edges, on stress meshes" * doctest::skip(SANITIZED)) {
    std::mt19937_64 random(12);
    for (const auto& families : {stress_families(), unorientable_families()})
        for (const StressFamily& family : families) {
            CAPTURE(std::string(family.name));
            const Soup soup = family.draw(random);
            for (const uint32_t engine : ENGINES) check_edge_costs(soup, engine, random, 0.02);
        }
}

TEST_CASE("vertex path: by a metric of the caller's that is the costs of edges") {
    std::mt19937_64 random(2);
    const Soup soup = jittered_grid(10, 3);
    const EdgeCosts costs(soup, random);
    HiddenCosts hidden;
    for (uint32_t v = 0; v < soup.vertex_count(); ++v) hidden.distances.push_back(costs.distances(v));
    for (const uint32_t engine : ENGINES) {
        const PathCase on(soup, callback_options(engine, HiddenCosts::call, &hidden));
        for (size_t i = 0; i < 20; ++i) {
            const auto from = random_point(soup, random, 3), to = random_point(soup, random, 3);
            double length = -1;
            check_callback_path(on, from, to, length);
            const double least = hidden.distances[id_of(on, from)][id_of(on, to)];
            CHECK(length <= least * 1.02 + 1e-6);
            CHECK(length >= least * 0.98 - 1e-6);
        }
    }
}

TEST_CASE("vertex path: by a metric of the caller's that leads through space") {
    std::mt19937_64 random(3);
    for (const Soup& soup : {bumpy_sphere(2, 5), pinched_sheets(3), joined(sphere(2), torus(9, 7, 1, 0.3))})
        for (const uint32_t engine : ENGINES) {
            StraightMetric straight{soup};
            const PathCase on(soup, callback_options(engine, StraightMetric::call, &straight));
            const PathCase edges(soup, path_options(engine, GEOIDX_METRIC_EDGES));
            for (size_t i = 0; i < 20; ++i) {
                const auto from = random_point(soup, random, 3), to = random_point(soup, random, 3);
                const uint32_t source = id_of(on, from), target = id_of(on, to);
                double length = -1, least = 0;
                REQUIRE(geoidx_solver_distances(edges.solver.get(), &source, 1, &target, 1, &least) ==
                        GEOIDX_OK);
                if (least == INFINITE) {
                    check_refused(ask_path(on, from, to, length), GEOIDX_ERROR_NO_PATH, "component");
                    continue;
                }
                check_callback_path(on, from, to, length);
                CHECK(length <= least * 1.05 + 1e-6);
            }
        }
}

TEST_CASE("vertex path: from a vertex to itself") {
    std::mt19937_64 random(4);
    const Soup soup = torus(10, 8, 1, 0.4);
    const EdgeCosts costs(soup, random);
    const PathCase on(soup, costs.options(GEOIDX_ENGINE_OVERLAY));
    const auto from = corner(5, 1);
    double length = -1;
    require_success(ask_path(on, from, from, length));
    CHECK(length == 0);
    CHECK(points_of(on).size() == 2);
}

TEST_CASE("vertex path: refused between vertices, and without the costs") {
    std::mt19937_64 random(5);
    const Soup soup = torus(10, 8, 1, 0.4);
    const EdgeCosts costs(soup, random);
    StraightMetric straight{soup};
    const auto inside = random_point(soup, random, 0), on_edge = random_point(soup, random, 2),
               fine = corner(7, 0);
    double length = 0;
    for (const auto& options : {costs.options(GEOIDX_ENGINE_OVERLAY),
                                callback_options(GEOIDX_ENGINE_GRAPH, StraightMetric::call, &straight)}) {
        const PathCase on(soup, options);
        check_refused(ask_path(on, inside, fine, length), GEOIDX_ERROR_INVALID_ARGUMENT,
                      "source is at no vertex");
        check_refused(ask_path(on, fine, on_edge, length), GEOIDX_ERROR_INVALID_ARGUMENT,
                      "target is at no vertex");
        check_refused(geoidx_query_prepare_target(on.query.get(), on.surface.get(), &inside),
                      GEOIDX_ERROR_INVALID_ARGUMENT, "target is at no vertex");
        prepare(on, fine);
        std::array<geoidx_path_point, 2> step;
        check_refused(geoidx_query_next_step(on.query.get(), on.surface.get(), &inside, step.data(), nullptr),
                      GEOIDX_ERROR_INVALID_ARGUMENT, "from is at no vertex");
        float distance = 0;
        check_refused(geoidx_query_point_sssd(on.query.get(), on.surface.get(), &inside, &fine, &distance),
                      GEOIDX_ERROR_INVALID_ARGUMENT, "metric");
    }
    const PathCase on(soup, costs.options(GEOIDX_ENGINE_OVERLAY));
    const PathCase plain(soup);
    const auto ask_on = [&](const geoidx_surface* surface) {
        return geoidx_query_path(on.query.get(), surface, &fine, &fine, GEOIDX_PATH_STRAIGHT, &length);
    };
    check_refused(ask_on(plain.surface.get()), GEOIDX_ERROR_INVALID_ARGUMENT, "edge_costs");
    const EdgeCosts others(soup, random);
    const PathCase other(soup, others.options(GEOIDX_ENGINE_OVERLAY));
    check_refused(ask_on(other.surface.get()), GEOIDX_ERROR_INVALID_ARGUMENT, "edge_costs");
}

// One surface may serve indices of several metrics.
TEST_CASE("vertex path: costs of a surface are nothing to an index that was built without") {
    std::mt19937_64 random(6);
    const Soup soup = jittered_grid(9, 2);
    const EdgeCosts costs(soup, random);
    const PathCase with_costs(soup, costs.options(GEOIDX_ENGINE_OVERLAY));
    for (const uint32_t metric : {GEOIDX_METRIC_EDGES, GEOIDX_METRIC_EXACT}) {
        const PathCase on(soup, path_options(GEOIDX_ENGINE_OVERLAY, metric));
        const auto from = corner(3, 0), to = corner(100, 1);
        double length = 0, same = -1;
        require_success(ask_path(on, from, to, length));
        require_success(geoidx_query_path(on.query.get(), with_costs.surface.get(), &from, &to,
                                          GEOIDX_PATH_STRAIGHT, &same));
        CHECK(same == length);
    }
}
