// Metrics that have parameters, and points of the surface, through the C API.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "tests/capi/refusals.h"

using namespace geodesic::test;

namespace {

SolverHandle solver_of(const TestMesh& mesh, const geoidx_build_options& options) {
    const geoidx_mesh view = mesh.view();
    geoidx_solver* solver = nullptr;
    require_success(geoidx_solver_create(&view, &options, &solver));
    return SolverHandle(solver);
}

double distance(geoidx_solver* solver, uint32_t source, uint32_t target) {
    double d = -1;
    require_success(geoidx_solver_distances(solver, &source, 1, &target, 1, &d));
    return d;
}

geoidx_build_options weighted(const std::vector<double>& costs) {
    auto options = build_options(GEOIDX_METRIC_WEIGHTED, 1);
    options.face_costs = costs.data();
    options.face_cost_count = costs.size();
    return options;
}

// The lengths of the sides of all triangles, each opposite to a corner.
std::vector<double> sides_of(const TestMesh& mesh) {
    std::vector<double> sides;
    for (size_t t = 0; t < mesh.triangles.size(); t += 3)
        for (size_t k = 0; k < 3; ++k) {
            double square = 0;
            for (size_t axis = 0; axis < 3; ++axis) {
                const auto at = [&](size_t corner) {
                    return double{mesh.positions[3 * size_t{mesh.triangles[t + corner % 3]} + axis]};
                };
                square += std::pow(at(k + 1) - at(k + 2), 2);
            }
            sides.push_back(std::sqrt(square));
        }
    return sides;
}

geoidx_surface_point point(uint32_t triangle, double a, double b, double c) {
    return {triangle, 0, {a, b, c}};
}

double point_distance(geoidx_solver* solver, const geoidx_surface_point& a, const geoidx_surface_point& b) {
    double d = -1;
    require_success(geoidx_solver_point_distances(solver, &a, 1, &b, 1, &d));
    return d;
}

}

TEST_CASE("a callback need not know that a vertex is 0 from itself") {
    struct Metric {
        static geoidx_status distances(void*, uint32_t source, const uint32_t* targets, uint32_t count,
                                       double* out) {
            for (uint32_t i = 0; i < count; ++i)
                out[i] = targets[i] == source
                             ? std::numeric_limits<double>::infinity()
                             : std::abs(static_cast<double>(targets[i]) - static_cast<double>(source));
            return GEOIDX_OK;
        }
    };
    TestMesh mesh = grid(12, 11);
    append(mesh, grid(3, 3), 20);
    for (const uint32_t engine : {GEOIDX_ENGINE_GRAPH, GEOIDX_ENGINE_OVERLAY}) {
        auto options = build_options(GEOIDX_METRIC_CALLBACK, 2);
        options.engine = engine;
        options.metric_callback = Metric::distances;
        const auto index = build(mesh, options);
        CHECK(sssd(index.get(), 7, 7) == 0);
        CHECK(sssd(index.get(), 7, 8) >= 0.99f);
        CHECK(sssd(index.get(), 7, 8) < 140);
    }
}

// Vertices that nothing joins, as walls, are parts of the mesh all the same.
TEST_CASE("a mesh is split although a callback joins some vertices to no other") {
    const auto distances = [](void* user, uint32_t source, const uint32_t* targets, uint32_t count,
                              double* out) {
        const auto& mesh = *static_cast<const TestMesh*>(user);
        const auto is_wall = [](uint32_t v) { return v % 10 == 3; };
        for (uint32_t i = 0; i < count; ++i)
            out[i] = is_wall(source) || is_wall(targets[i]) ? std::numeric_limits<double>::infinity()
                                                            : mesh.straight(source, targets[i]);
        return geoidx_status{GEOIDX_OK};
    };
    TestMesh mesh = grid(30, 30);
    for (uint64_t seed = 1; seed <= 10; ++seed) {
        auto options = build_options(GEOIDX_METRIC_CALLBACK, 1);
        options.patches[0] = 6;
        options.seed = seed;
        options.metric_callback = distances;
        options.metric_user = &mesh;
        const auto index = build(mesh, options);
        CHECK(info_of(index.get()).patch_count[0] >= 4);
    }
}

TEST_CASE("face costs count, in the index and without one") {
    const TestMesh mesh = hills(9, 9);
    const std::vector<double> ones(mesh.triangles.size() / 3, 1), threes(ones.size(), 3);
    const auto plain = build(mesh, weighted(ones)), dear = build(mesh, weighted(threes));
    const auto exact = solver_of(mesh, build_options());
    for (const auto& [a, b] : {std::pair{0u, 80u}, {5u, 60u}, {33u, 41u}}) {
        CHECK(sssd(dear.get(), a, b) == doctest::Approx(3 * sssd(plain.get(), a, b)).epsilon(1e-6));
        CHECK(sssd(plain.get(), a, b) >= distance(exact.get(), a, b) * (1 - 1e-6));
        CHECK(sssd(plain.get(), a, b) <= distance(exact.get(), a, b) * 1.06);
    }
    CHECK(info_of(plain.get()).metric == GEOIDX_METRIC_WEIGHTED);
    CHECK(info_of(plain.get()).metric_flags == 0);
    CHECK(info_of(plain.get()).metric_fingerprint != info_of(dear.get()).metric_fingerprint);

    // Two triangles, one dear: along the diagonal the cheap one counts.
    const TestMesh square = two_triangles();
    const auto solver = solver_of(square, weighted({1, 10}));
    CHECK(distance(solver.get(), 0, 2) == doctest::Approx(std::sqrt(2.0)));
    // To the far corner of the dear one: along the diagonal for a while, then off it at the critical angle,
    // whose sine is 1 / 10. Half a diagonal lies between the corner and the diagonal, and before its foot.
    const double half = std::sqrt(0.5), bent = half + half * std::sqrt(99.0);
    CHECK(distance(solver.get(), 0, 3) >= bent * (1 - 1e-12));
    CHECK(distance(solver.get(), 0, 3) <= bent * 1.005);
    CHECK(distance(solver.get(), 0, 1) == doctest::Approx(1));
}

TEST_CASE("face costs are validated") {
    const TestMesh mesh = hills(3, 3);
    std::vector<double> costs(mesh.triangles.size() / 3, 1);
    const auto refused = [&](const geoidx_build_options& options, const char* detail) {
        check_build_refused(mesh, options, GEOIDX_ERROR_INVALID_ARGUMENT, detail);
    };
    for (double cost : {double{NOT_A_NUMBER}, 0.0, -1.0, double{INFINITE}}) {
        costs[5] = cost;
        refused(weighted(costs), "triangle 5");
    }
    costs[5] = 1;
    auto options = weighted(costs);
    options.face_costs = nullptr;
    refused(options, "face_costs");
    options = weighted(costs);
    --options.face_cost_count;
    refused(options, "face_cost_count");
    options = weighted(costs);
    options.points_per_edge = 1001;
    refused(options, "points_per_edge");
}

TEST_CASE("costs are refused that leave a float nothing of a distance") {
    const TestMesh mesh = grid(3, 3, 0);
    const auto refused = [](const TestMesh& of, const geoidx_build_options& options, const std::string& who) {
        const std::string detail = who + ", too small: distances would not fit a 32-bit float";
        check_build_refused(of, options, GEOIDX_ERROR_LIMIT, detail.c_str());
    };
    std::vector<double> of_faces(mesh.triangles.size() / 3, 1);
    of_faces[5] = 1e-39;
    refused(mesh, weighted(of_faces), "triangle 5 has the cost 1e-39");
    of_faces[5] = 1e-300;
    refused(mesh, weighted(of_faces), "triangle 5 has the cost 1e-300");
    TestMesh small = mesh; // whose sides times the cost are not even doubles
    for (double& coordinate : small.positions) coordinate *= 1e-30;
    refused(small, weighted(of_faces), "triangle 5 has the cost 1e-300");
    const uint32_t vertices[] = {4, 1};
    double of_edge = 1e-44;
    auto options = build_options(GEOIDX_METRIC_EDGES);
    options.edge_cost_count = 1;
    options.edge_cost_vertices = vertices;
    options.edge_costs = &of_edge;
    refused(mesh, options, "the edge between vertices 1 and 4 has the cost 1e-44");
}

TEST_CASE("costs that a float can hold count, however small, and none is a cost, too") {
    const TestMesh square = two_triangles(); // 0-1-2-3 around, diagonal 0-2
    for (const uint32_t engine : {GEOIDX_ENGINE_GRAPH, GEOIDX_ENGINE_OVERLAY}) {
        CAPTURE(engine);
        const std::vector<double> of_faces(2, 1e-30);
        auto faces = weighted(of_faces);
        faces.engine = engine;
        const auto by_faces = build(square, faces);
        CHECK(sssd(by_faces.get(), 0, 1) == doctest::Approx(1e-30).epsilon(1e-3));
        const uint32_t vertices[] = {0, 1, 1, 2};
        const double costs[] = {0, 1e-30};
        auto edges = build_options(GEOIDX_METRIC_EDGES);
        edges.engine = engine;
        edges.edge_cost_count = 2;
        edges.edge_cost_vertices = vertices;
        edges.edge_costs = costs;
        CHECK(sssd(build(square, edges).get(), 1, 2) > 0);
    }
}

TEST_CASE("a surface given by lengths is the surface that has them") {
    TestMesh mesh = hills(8, 7);
    const auto sides = sides_of(mesh);
    const auto by_positions = solver_of(mesh, build_options());
    // The same lengths on a mesh that lies flat and is scaled: positions do not count.
    for (size_t v = 0; v < mesh.positions.size(); v += 3) mesh.positions[v + 2] = 0;
    for (auto& coordinate : mesh.positions) coordinate *= 7;
    auto options = build_options();
    options.edge_lengths = sides.data();
    options.edge_length_count = sides.size();
    const auto by_lengths = solver_of(mesh, options);
    for (uint32_t a : {0u, 20u, 55u})
        for (uint32_t b = 0; b < 56; ++b)
            CHECK(distance(by_lengths.get(), a, b) ==
                  doctest::Approx(distance(by_positions.get(), a, b)).epsilon(1e-9));
    const auto index = build(mesh, options);
    CHECK(sssd(index.get(), 0, 55) >= distance(by_positions.get(), 0, 55) * (1 - 1e-6));
    CHECK(sssd(index.get(), 0, 55) <= distance(by_positions.get(), 0, 55) * 1.05);
    CHECK(info_of(index.get()).metric_fingerprint != 0);
}

TEST_CASE("lengths that no surface has are refused, and the triangle or the edge named") {
    const TestMesh mesh = hills(4, 4);
    const auto good = sides_of(mesh);
    const auto refused = [&](const std::function<void(std::vector<double>&)>& change, const char* detail) {
        auto sides = good;
        change(sides);
        auto options = build_options();
        options.edge_lengths = sides.data();
        options.edge_length_count = sides.size();
        check_build_refused(mesh, options, GEOIDX_ERROR_BAD_MESH, detail);
    };
    for (double length : {0.0, -1.0, double{NOT_A_NUMBER}, double{INFINITE}})
        refused([&](auto& sides) { sides[3 * 6 + 1] = length; }, "triangle 6 has a side of length");
    refused([&](auto& sides) { sides[3 * 4] = sides[3 * 4 + 1] + sides[3 * 4 + 2] + 1; },
            "triangle 4 has a side longer");
    refused(
        [&](auto& sides) {
            sides[0] = 1;
            sides[1] = 2;
            sides[2] = 3;
        },
        "triangle 0 has no area");
    refused(
        [&](auto& sides) {
            for (size_t k = 0; k < 3; ++k) sides[k] *= 1.001;
        },
        "two lengths");
    // Each triangle has an area of its own, but not with the length that its neighbour gives their edge.
    const TestMesh pair = two_triangles();
    auto options = build_options();
    options.edge_length_count = 6;
    const double long_first[] = {1, 1, 1, 0.5, 0.5 - 1e-10, 1 - 0.5e-9};
    options.edge_lengths = long_first;
    check_build_refused(pair, options, GEOIDX_ERROR_BAD_MESH, "triangle 1");
    for (double scale : {1e-80, 1e80})
        refused(
            [&](auto& sides) {
                for (double& side : sides) side *= scale;
            },
            "triangle 0 has a side of length");
    options.edge_lengths = good.data();
    options.edge_length_count = good.size() - 1;
    check_build_refused(mesh, options, GEOIDX_ERROR_INVALID_ARGUMENT, "edge_length_count");
    options.edge_lengths = nullptr;
    options.edge_length_count = good.size();
    check_build_refused(mesh, options, GEOIDX_ERROR_INVALID_ARGUMENT, "edge_lengths");
}

TEST_CASE("a callback metric declares whether it can be unfolded") {
    const TestMesh mesh = two_triangles();
    auto options = build_options(GEOIDX_METRIC_CALLBACK, 1);
    options.metric_callback = [](void*, uint32_t source, const uint32_t* targets, uint32_t count,
                                 double* distances) {
        for (uint32_t i = 0; i < count; ++i) distances[i] = targets[i] == source ? 0 : 1;
        return geoidx_status{GEOIDX_OK};
    };
    CHECK(info_of(build(mesh, options).get()).metric_flags == 0);
    options.metric_flags = GEOIDX_METRIC_UNFOLDABLE;
    CHECK(info_of(build(mesh, options).get()).metric_flags == GEOIDX_METRIC_UNFOLDABLE);
    options.metric_flags = 2;
    check_build_refused(mesh, options, GEOIDX_ERROR_INVALID_ARGUMENT, "metric_flags");
    CHECK(info_of(build(mesh, build_options()).get()).metric_flags == GEOIDX_METRIC_UNFOLDABLE);
    CHECK(info_of(build(mesh, build_options(GEOIDX_METRIC_EDGES)).get()).metric_flags == 0);
}

TEST_CASE("costs and lengths are refused by metrics that do not take them") {
    const TestMesh mesh = two_triangles();
    const geoidx_mesh view = mesh.view();
    const std::vector<double> of_faces(2, 1), lengths = sides_of(mesh);
    const uint32_t vertices[] = {0, 1};
    const double of_edge = 1;
    const auto by = [](uint32_t metric) {
        auto options = build_options(metric, 1);
        options.metric_callback = [](void*, uint32_t, const uint32_t*, uint32_t, double*) {
            return geoidx_status{GEOIDX_OK};
        };
        return options;
    };
    const auto refused = [&](const geoidx_build_options& options, const char* name, const char* metrics) {
        CAPTURE(options.metric);
        for (const char* const part : {name, metrics}) {
            check_build_refused(mesh, options, GEOIDX_ERROR_INVALID_ARGUMENT, part);
            geoidx_solver* solver = nullptr;
            check_refused(geoidx_solver_create(&view, &options, &solver), GEOIDX_ERROR_INVALID_ARGUMENT,
                          part);
            CHECK(solver == nullptr);
        }
    };
    for (const uint32_t metric : {GEOIDX_METRIC_EXACT, GEOIDX_METRIC_CALLBACK, GEOIDX_METRIC_WEIGHTED}) {
        auto options = by(metric);
        options.edge_cost_vertices = vertices;
        options.edge_costs = &of_edge;
        options.edge_cost_count = 1;
        refused(options, "edge_costs", "GEOIDX_METRIC_EDGES");
        options.edge_costs = nullptr;
        refused(options, "edge_cost_count", "GEOIDX_METRIC_EDGES");
    }
    for (const uint32_t metric : {GEOIDX_METRIC_EXACT, GEOIDX_METRIC_EDGES, GEOIDX_METRIC_CALLBACK}) {
        auto options = by(metric);
        options.face_costs = of_faces.data();
        refused(options, "face_costs", "GEOIDX_METRIC_WEIGHTED");
        options.face_cost_count = of_faces.size();
        refused(options, "face_costs", "GEOIDX_METRIC_WEIGHTED");
        options.face_costs = nullptr;
        refused(options, "face_cost_count", "GEOIDX_METRIC_WEIGHTED");
    }
    for (const uint32_t metric : {GEOIDX_METRIC_EDGES, GEOIDX_METRIC_CALLBACK}) {
        auto options = by(metric);
        options.edge_lengths = lengths.data();
        refused(options, "edge_lengths", "GEOIDX_METRIC_EXACT or GEOIDX_METRIC_WEIGHTED");
        options.edge_length_count = lengths.size();
        refused(options, "edge_lengths", "GEOIDX_METRIC_EXACT or GEOIDX_METRIC_WEIGHTED");
        options.edge_lengths = nullptr;
        refused(options, "edge_length_count", "GEOIDX_METRIC_EXACT or GEOIDX_METRIC_WEIGHTED");
    }
    auto without_count = by(GEOIDX_METRIC_EXACT);
    without_count.edge_lengths = lengths.data();
    refused(without_count, "edge_length_count is 0", "not three for each of 2 triangles");
}

TEST_CASE("a list of edge costs may be empty, with any metric") {
    const TestMesh mesh = two_triangles();
    const uint32_t vertices[] = {0, 1};
    const double of_edge = 5;
    for (const uint32_t metric : {GEOIDX_METRIC_EXACT, GEOIDX_METRIC_EDGES}) {
        auto options = build_options(metric, 1);
        options.edge_cost_vertices = vertices;
        options.edge_costs = &of_edge;
        CHECK(distance(solver_of(mesh, options).get(), 0, 1) == 1);
    }
}

TEST_CASE("unknown flags of a metric are refused, whatever the metric") {
    const TestMesh mesh = two_triangles();
    const geoidx_mesh view = mesh.view();
    for (const uint32_t metric : {GEOIDX_METRIC_EXACT, GEOIDX_METRIC_EDGES}) {
        auto options = build_options(metric, 1);
        options.metric_flags = GEOIDX_METRIC_UNFOLDABLE;
        CHECK(distance(solver_of(mesh, options).get(), 0, 1) == 1);
        options.metric_flags = 2;
        check_build_refused(mesh, options, GEOIDX_ERROR_INVALID_ARGUMENT, "metric_flags is 2");
        geoidx_solver* solver = nullptr;
        check_refused(geoidx_solver_create(&view, &options, &solver), GEOIDX_ERROR_INVALID_ARGUMENT,
                      "metric_flags is 2");
    }
}

TEST_CASE("points of the surface") {
    TestMesh mesh = two_triangles();                        // the unit square, 0-1-2 and 0-2-3
    mesh.triangles.insert(mesh.triangles.end(), {2, 1, 0}); // triangle 2 repeats 0, its corners the other way
    mesh.triangles.insert(mesh.triangles.end(), {0, 0, 1});
    const auto solver = solver_of(mesh, build_options());
    // (0.75, 0.25) and (0.25, 0.75), across the diagonal.
    const auto a = point(0, 0.25, 0.5, 0.25), b = point(1, 0.25, 0.25, 0.5);
    CHECK(point_distance(solver.get(), a, b) == doctest::Approx(std::sqrt(0.5)));
    CHECK(point_distance(solver.get(), a, a) == 0);
    CHECK(point_distance(solver.get(), a, point(1, 0, 0, 1)) == doctest::Approx(std::hypot(0.75, 0.75)));
    const auto of_duplicate = point(2, 0.2, 0.7, 0.1), of_first = point(0, 0.1, 0.7, 0.2);
    CHECK(point_distance(solver.get(), of_duplicate, of_first) == doctest::Approx(0).scale(1));
    CHECK(point_distance(solver.get(), b, of_duplicate) ==
          doctest::Approx(point_distance(solver.get(), b, of_first)));

    const geoidx_surface_point both[] = {a, b};
    double d[2];
    require_success(geoidx_solver_point_distances(solver.get(), both, 2, both, 2, d));
    CHECK(d[0] == 0);
    CHECK(d[1] == 0);
    require_success(geoidx_solver_point_distances(solver.get(), both, 2, nullptr, 0, nullptr));
}

TEST_CASE("points that are not on the surface are refused by name") {
    TestMesh mesh = two_triangles();
    mesh.triangles.insert(mesh.triangles.end(), {0, 0, 1});
    const auto solver = solver_of(mesh, build_options());
    const auto good = point(0, 1, 0, 0);
    const auto refused = [&](const geoidx_surface_point& bad, const char* detail) {
        double d[2];
        const geoidx_surface_point points[] = {good, bad};
        check_refused(geoidx_solver_point_distances(solver.get(), points, 2, &good, 1, d),
                      GEOIDX_ERROR_INVALID_ARGUMENT, ("source 1" + std::string(detail)).c_str());
        check_refused(geoidx_solver_point_distances(solver.get(), &good, 1, points, 2, d),
                      GEOIDX_ERROR_INVALID_ARGUMENT, ("target 1" + std::string(detail)).c_str());
    };
    refused(point(3, 1, 0, 0), " is on triangle 3");
    refused(point(2, 1, 0, 0), " is on triangle 2, which is degenerate");
    refused(point(0, 1.5, -0.5, 0), " has the weight -0.5");
    refused(point(0, NOT_A_NUMBER, 0.5, 0.5), " has the weight");
    refused(point(0, 0.5, 0.4, 0), " has weights of 0.9");
    refused(point(0, INFINITE, 0, 0), " has weights of");
    double d = 0;
    CHECK(geoidx_solver_point_distances(nullptr, &good, 1, &good, 1, &d) == GEOIDX_ERROR_INVALID_ARGUMENT);
    CHECK(geoidx_solver_point_distances(solver.get(), nullptr, 1, &good, 1, &d) ==
          GEOIDX_ERROR_INVALID_ARGUMENT);
    CHECK(geoidx_solver_point_distances(solver.get(), &good, 0, &good, 1, &d) ==
          GEOIDX_ERROR_INVALID_ARGUMENT);
    CHECK(geoidx_solver_point_distances(solver.get(), &good, 1, &good, 1, nullptr) ==
          GEOIDX_ERROR_INVALID_ARGUMENT);
    const auto edges = solver_of(mesh, build_options(GEOIDX_METRIC_EDGES));
    check_refused(geoidx_solver_point_distances(edges.get(), &good, 1, &good, 1, &d),
                  GEOIDX_ERROR_INVALID_ARGUMENT, "vertices only");
}

TEST_CASE("solver_tolerance: a share within its limits, and 0 in a shorter struct") {
    const TestMesh mesh = hills(40, 12);
    const geoidx_mesh view = mesh.view();
    auto options = build_options();
    const auto exact = solver_of(mesh, options);
    options.solver_tolerance = 1e-4;
    const auto tolerant = solver_of(mesh, options);
    options.struct_size = offsetof(geoidx_build_options, solver_tolerance);
    const auto shorter = solver_of(mesh, options);
    uint32_t different = 0;
    for (uint32_t v = 1; v < mesh.vertex_count(); ++v) {
        const double expected = distance(exact.get(), 0, v), found = distance(tolerant.get(), 0, v);
        CHECK(found == doctest::Approx(expected).epsilon(5e-3));
        different += found != expected;
        CHECK(distance(shorter.get(), 0, v) == expected);
    }
    CHECK(different > 0);
    options.struct_size = sizeof(options);
    for (const double wrong : {-1e-9, 1.1e-4, double{NOT_A_NUMBER}, double{INFINITE}}) {
        options.solver_tolerance = wrong;
        geoidx_solver* solver = nullptr;
        check_refused(geoidx_solver_create(&view, &options, &solver), GEOIDX_ERROR_INVALID_ARGUMENT,
                      "solver_tolerance");
        geoidx* index = nullptr;
        check_refused(geoidx_build(&view, &options, &index), GEOIDX_ERROR_INVALID_ARGUMENT,
                      "solver_tolerance");
    }
}
