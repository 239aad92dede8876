// Distances of points of the surface by an index, compared with the exact metric.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "src/base/rounded.h"
#include "src/capi/handles.h"
#include "tests/capi/refusals.h"
#include "tests/path/path_cases.h"
#include "tests/points/point_cases.h"
#include "tests/support/drilled_plate.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

Soup comb_of_slivers() { return scaled(with_random_diagonals(comb(2), 20, 33), 1, 1e-4, 1); }

bool is_flat(const Soup& soup) { return soup.positions[0].z() == 0 && soup.positions.back().z() == 0; }

void raise_at_random(Soup& soup, std::mt19937_64& random) {
    for (Eigen::Vector3d& at : soup.positions) at.z() = uniform(random, 0, 2);
}

uint32_t id_at(const Soup& soup, const geoidx_surface_point& point) {
    return soup.triangles[point.triangle]
                         [static_cast<size_t>(std::ranges::max_element(point.weights) - point.weights)];
}

// From random points.
double mean_of_fields(const PathCase& on) {
    std::vector<geoidx_surface_point> vertices;
    for (uint32_t id = 0; id < on.soup.vertex_count(); ++id) vertices.push_back(on.at_vertex(id));
    std::mt19937_64 random(8);
    MeanError error;
    for (size_t i = 0; i < 60; ++i) {
        const auto source = random_point(on.soup, random, 0);
        const auto answers = field(on, {&source, 1});
        std::vector<double> exact(vertices.size());
        require_success(geoidx_solver_point_distances(on.solver.get(), &source, 1, vertices.data(),
                                                      static_cast<uint32_t>(vertices.size()), exact.data()));
        for (size_t v = 0; v < vertices.size(); ++v)
            if (std::isfinite(exact[v])) error.add(double{answers[v]}, exact[v]);
    }
    return error.mean();
}

}

TEST_CASE("points: pairs are about as accurate as those of vertices, and symmetric" *
          doctest::skip(SANITIZED)) {
    for (const uint32_t engine : {GEOIDX_ENGINE_OVERLAY, GEOIDX_ENGINE_GRAPH})
        for (const Soup& soup : {bumpy_sphere(4, 3), torus(40, 22, 1, 0.4), jittered_grid(30, 4)}) {
            const PathCase on(soup, path_options(engine));
            std::mt19937_64 random(1);
            MeanError points, vertices;
            for (size_t i = 0; i < 500; ++i) {
                const auto a = random_point(on.soup, random, 0), b = random_point(on.soup, random, 0);
                points.add(on.sssd(a, b), on.exact(a, b));
                CHECK(on.sssd(a, b) == on.sssd(b, a));
                const auto c = random_point(on.soup, random, 3), d = random_point(on.soup, random, 3);
                vertices.add(on.sssd(c, d), on.exact(c, d));
            }
            CHECK(points.mean() <= 2 * vertices.mean() + 6e-3);
        }
}

// Where triangles are large for what the surface does, as in games, and with vertices added to their edges.
TEST_CASE("points: on rough surfaces of few triangles they are at most twice as far off as vertices" *
          doctest::skip(SANITIZED)) {
    for (const double target_error : {0.0, 5e-4})
        for (Soup soup : {bumpy_sphere(3, 3), grid(20, 20, 20, 20), cube(6)}) {
            auto options = path_options();
            options.target_error = target_error;
            std::mt19937_64 random(7);
            if (is_flat(soup)) raise_at_random(soup, random);
            const PathCase on(soup, options);
            CAPTURE(target_error);
            CAPTURE(on.soup.vertex_count());
            MeanError points, vertices;
            for (size_t i = 0; i < 1200; ++i) {
                const auto a = random_point(on.soup, random, 0), b = random_point(on.soup, random, 0);
                points.add(on.sssd(a, b), on.exact(a, b));
                const auto c = random_point(on.soup, random, 3), d = random_point(on.soup, random, 3);
                vertices.add(on.sssd(c, d), on.exact(c, d));
            }
            CHECK(points.mean() <= 2 * vertices.mean() + 2e-4);
        }
}

// Added vertices cut some of the edges, and lie in line with the points of these.
TEST_CASE("points: on edges they are as accurate as beside them" * doctest::skip(SANITIZED)) {
    for (Soup soup : {bumpy_sphere(3, 3), grid(20, 20, 20, 20), cube(6)}) {
        std::mt19937_64 random(11);
        if (is_flat(soup)) raise_at_random(soup, random);
        const PathCase on(soup, default_options());
        CAPTURE(on.soup.vertex_count());
        double farthest_apart = 0;
        MeanError on_edges, beside_them;
        for (size_t i = 0; i < 300; ++i) {
            const auto edge_point =
                random_edge_point(random, static_cast<uint32_t>(random() % on.soup.triangles.size()));
            geoidx_surface_point beside = edge_point;
            for (double& weight : beside.weights) weight = (weight + 1e-4 / 3) / (1 + 1e-4);
            const auto from_edge = field(on, {&edge_point, 1}), from_beside = field(on, {&beside, 1});
            const double edge = longest_edge(on, edge_point);
            for (size_t v = 0; v < from_edge.size(); ++v)
                farthest_apart =
                    std::max(farthest_apart, double{std::abs(from_edge[v] - from_beside[v])} / edge);
            const auto to = random_point(on.soup, random, 0);
            const double exact = on.exact(edge_point, to);
            on_edges.add(on.sssd(edge_point, to), exact);
            beside_them.add(on.sssd(beside, to), exact);
        }
        CHECK(farthest_apart < 0.05);
        CHECK(on_edges.mean() <= 1.05 * beside_them.mean() + 1e-4);
    }
}

// What lies behind a cap is seen over all of its rim, or else unfolded over chords far too near.
TEST_CASE("points: on cylinders whose caps have no vertex inside") {
    for (const double height : {0.2, 2.0}) {
        const PathCase on(closed_cylinder(32, height), default_options());
        std::mt19937_64 random(7);
        MeanError points;
        size_t over_a_twentieth = 0;
        for (size_t i = 0; i < 1000; i += sparse(1)) {
            const auto a = random_point(on.soup, random, 0), b = random_point(on.soup, random, 0);
            const double distance = on.sssd(a, b), exact = on.exact(a, b);
            points.add(distance, exact);
            over_a_twentieth += std::abs(distance - exact) > exact / 20;
        }
        CAPTURE(height);
        CHECK(points.mean() < 0.003);
        CHECK(over_a_twentieth <= points.count / 100);
    }
}

// Fields from its vertices are exact enough without.
TEST_CASE("points: vertices are added where fields from points are less exact than asked for" *
          doctest::skip(SANITIZED)) {
    const Soup column = closed_cylinder(256, 20);
    auto options = default_options();
    const double target = options.target_error;
    const PathCase as_asked(column, options);
    options.target_error = 0;
    const PathCase without(column, options);
    const double error_without = mean_of_fields(without);
    REQUIRE(info_of(without.index.get()).error_mean < target);
    REQUIRE(error_without > 2 * target);
    CHECK(info_of(as_asked.index.get()).added_vertex_count > 0);
    CHECK(mean_of_fields(as_asked) < 0.5 * error_without);
}

// A long wall in one plane whose upper edge has teeth: one triangle has the whole lower edge, and ways from
// it bend at the feet of teeth that lie beyond the border of its leaf.
Soup battlement(uint32_t teeth) {
    Soup wall;
    wall.positions = {{0, 0, 0}, {double(teeth), 0, 0}};
    for (uint32_t i = 0; i < teeth; ++i) {
        const double left = i + 0.4, right = i + 0.6;
        for (const double height : {0.5, 4.5}) {
            wall.positions.emplace_back(left, height, 0);
            wall.positions.emplace_back(right, height, 0);
        }
        const uint32_t foot = 2 + 4 * i;
        wall.triangles.push_back({foot, foot + 1, foot + 3});
        wall.triangles.push_back({foot, foot + 3, foot + 2});
        wall.triangles.push_back({0, foot + 1, foot});
        wall.triangles.push_back({0, i + 1 < teeth ? foot + 4 : 1, foot + 1});
    }
    return wall;
}

TEST_CASE("points: fields go over vertices that are seen beyond the leaf") {
    const PathCase on(battlement(60));
    std::mt19937_64 random(5);
    for (size_t i = 0; i < 100; i += sparse(1)) {
        CAPTURE(i);
        const geoidx_surface_point sources[] = {random_point(on.soup, random, 0),
                                                random_point(on.soup, random, 0)};
        const auto alone = field(on, {sources, 1}), both = field(on, sources);
        const auto exact = on.exact_field(sources[0]), exact_of_other = on.exact_field(sources[1]);
        const auto threads = static_cast<uint32_t>(1 + i % 3);
        REQUIRE(geoidx_query_set_threads(on.query.get(), threads) == GEOIDX_OK);
        CHECK(field(on, {sources, 1}) == alone);
        for (size_t v = 0; v < exact.size(); ++v) {
            CHECK(std::abs(double{alone[v]} - exact[v]) <= 0.01 * exact[v]);
            const double least = std::min(exact[v], exact_of_other[v]);
            CHECK(std::abs(double{both[v]} - least) <= 0.01 * least);
        }
    }
}

// A part does not tell how far away others are.
TEST_CASE("points: on parts that lie far from each other they are as exact as on one of them") {
    const Soup column = closed_cylinder(54, 6);
    Soup apart = column;
    for (Eigen::Vector3d& at : apart.positions) at += Eigen::Vector3d(2000, 300, 0);
    const double alone = mean_of_fields(PathCase(column)),
                 together = mean_of_fields(PathCase(joined(column, apart)));
    CHECK(alone < 5e-4);
    CHECK(together < 5e-4);
}

// Its faces lie over each other, so that a position does not tell where a point is.
TEST_CASE("points: on a plane that covers itself, as the metric says") {
    for (const Soup& soup : {flat_fan(2), flat_spiral(3)}) {
        const PathCase on(with_random_diagonals(soup, 20, 3));
        std::mt19937_64 random(7);
        for (size_t i = 0; i < 600; i += sparse(1)) {
            CAPTURE(i);
            const auto a = random_point(on.soup, random, i), b = random_point(on.soup, random, i / 4);
            const double exact = on.exact(a, b);
            CHECK(std::abs(on.sssd(a, b) - exact) <= 0.02 * exact);
        }
    }
}

// Edges that are longer than others on the same line lead beyond their ends by no way of their own.
TEST_CASE("points: in triangles without area, no line leads past the end of an edge") {
    const std::vector<Eigen::Vector3d> positions{{0, 0, 0}, {0, 0, 1},  {0, 0, 2},
                                                 {0, 0, 3}, {1, 0, .5}, {-1, 0, 2.5}};
    using Triangles = std::vector<std::array<uint32_t, 3>>;
    for (const Triangles& triangles : {Triangles{{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {0, 5, 1}},
                                       Triangles{{0, 1, 2}, {1, 0, 3}, {0, 2, 4}, {0, 5, 3}}}) {
        Soup soup;
        soup.positions = positions;
        soup.triangles = triangles;
        const PathCase on(soup);
        std::mt19937_64 random(7);
        for (size_t i = 0; i < 300; ++i) {
            CAPTURE(i);
            const auto a = random_point(soup, random, i), b = random_point(soup, random, i / 4);
            const double exact = on.exact(a, b);
            CHECK(std::abs(on.sssd(a, b) - exact) <= 0.005 * exact + 1e-5);
        }
    }
}

// Around a point whose distances from the corners come from different sides, the straight way is off by a
// share of the triangle.
TEST_CASE("points: any pair of hard meshes, and those without a path") {
    size_t number = 0;
    for (const Soup& soup : path_soups()) {
        ++number;
        CAPTURE(number);
        const PathCase on(soup);
        std::mt19937_64 random(2);
        for (size_t i = 0; i < 60; ++i) {
            const auto a = random_point(on.soup, random, i), b = random_point(on.soup, random, i / 4);
            CAPTURE(i);
            const double exact = on.exact(a, b), distance = on.sssd(a, b);
            if (exact == INFINITE)
                CHECK(distance == INFINITE);
            else
                CHECK(std::abs(distance - exact) <=
                      0.05 * exact + 0.2 * (longest_edge(on, a) + longest_edge(on, b)));
        }
    }
}

// By this metric a way leads to a corner of each triangle, and the table between corners is exact: leaves may
// be so small that they have no vertex inside, or hold short distances only.
TEST_CASE("points: over the corners where edges are the metric, on small leaves, too") {
    for (uint64_t seed = 0; seed < 12; ++seed) {
        CAPTURE(seed);
        std::mt19937_64 random(seed);
        auto options = path_options(GEOIDX_ENGINE_OVERLAY, GEOIDX_METRIC_EDGES);
        options.level_count = 1;
        options.patches[0] = 5;
        const PathCase on(seed % 2 ? random_soup(random, 12, 10) : jittered_grid(5, seed), options);
        for (size_t i = 0; i < 60; ++i) {
            CAPTURE(i);
            const auto a = random_point(on.soup, random, 0), b = random_point(on.soup, random, 0);
            if (a.triangle == b.triangle) continue;
            const auto &of_a = on.soup.triangles[a.triangle], &of_b = on.soup.triangles[b.triangle];
            double least = INFINITE;
            for (const uint32_t from : of_a)
                for (const uint32_t to : of_b) {
                    double between = 0;
                    REQUIRE(geoidx_solver_distances(on.solver.get(), &from, 1, &to, 1, &between) ==
                            GEOIDX_OK);
                    least = std::min(least, (on.position(a) - on.soup.positions[from]).norm() + between +
                                                (on.soup.positions[to] - on.position(b)).norm());
                }
            CHECK(double{on.sssd(a, b)} == doctest::Approx(least).epsilon(1e-3));
        }
    }
}

// How near they are to it, tables do not tell.
TEST_CASE("points: of small leaves, and with two leaves that have both, they are symmetric" *
          doctest::skip(SANITIZED)) {
    for (uint64_t seed = 0; seed < 4; ++seed) {
        CAPTURE(seed);
        auto options = path_options();
        options.level_count = 1;
        options.patches[0] = 12;
        options.seed = seed;
        const PathCase on(bumpy_sphere(2, seed), options);
        std::mt19937_64 random(seed);
        uint32_t different = 0;
        for (size_t i = 0; i < 4000; ++i) {
            const auto a = random_point(on.soup, random, i % 5), b = random_point(on.soup, random, i % 3);
            different += on.sssd(a, b) != on.sssd(b, a);
        }
        CHECK(different == 0);
    }
}

// A plane of slivers: the index was made on other faces, which the surface must have, too.
TEST_CASE("points: an index without costs ignores those of the surface") {
    const PathCase on(with_random_diagonals(jittered_grid(16, 3), 40, 5));
    const std::vector<double> costs(on.soup.triangles.size(), 3.0);
    const uint32_t edge[] = {on.soup.triangles[0][0], on.soup.triangles[0][1]};
    const double edge_cost = 7;
    geoidx_surface_options of_faces, of_edges;
    geoidx_surface_options_init(&of_faces);
    of_faces.face_costs = costs.data();
    of_faces.face_cost_count = costs.size();
    geoidx_surface_options_init(&of_edges);
    of_edges.edge_cost_vertices = edge;
    of_edges.edge_costs = &edge_cost;
    of_edges.edge_cost_count = 1;
    for (const auto& options : {of_faces, of_edges}) {
        const geoidx_mesh view = view_of(on.soup);
        geoidx_surface* created = nullptr;
        REQUIRE(geoidx_surface_create(&view, &options, &created) == GEOIDX_OK);
        const SurfaceHandle with_costs(created);
        std::mt19937_64 random(3);
        for (size_t i = 0; i < 400; ++i) {
            const auto a = random_point(on.soup, random, i), b = random_point(on.soup, random, 0);
            CAPTURE(i);
            float distance = 0;
            REQUIRE(geoidx_query_point_sssd(on.query.get(), with_costs.get(), &a, &b, &distance) ==
                    GEOIDX_OK);
            CHECK(distance == on.sssd(a, b));
            CHECK(double{distance} ==
                  doctest::Approx((on.position(a) - on.position(b)).norm()).epsilon(1e-6));
        }
    }
}

TEST_CASE("points: by edges, a point on an edge has the ways of the triangle that it is given on") {
    Soup soup;
    for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) soup.positions.emplace_back(x, y, 0);
    soup.triangles = {{0, 1, 2}, {0, 2, 3}};
    const PathCase on(soup, path_options(GEOIDX_ENGINE_OVERLAY, GEOIDX_METRIC_EDGES));
    const geoidx_surface_point below{0, 0, {0.5, 0, 0.5}}, above{1, 0, {0.5, 0.5, 0}},
        corner{1, 0, {0, 0, 1}};
    const double half = std::sqrt(0.5);
    CHECK(double{on.sssd(below, corner)} == doctest::Approx(1 + half));
    CHECK(double{on.sssd(above, corner)} == doctest::Approx(half));
    CHECK(on.sssd(below, above) == 0);
    CHECK(double{field(on, std::span(&below, 1))[3]} == doctest::Approx(1 + half));
    CHECK(double{field(on, std::span(&above, 1))[3]} == doctest::Approx(half));
}

// Also where the corners of the triangle that a vertex is given on are in no leaf together: its edges within
// planes have been flipped.
TEST_CASE("points: at vertices they are these vertices" * doctest::skip(SANITIZED)) {
    for (const Soup& soup : {torus(16, 10, 1, 0.4), with_random_diagonals(jittered_grid(24, 3), 40, 5),
                             drilled_plate(3, 12, 0.02), comb_of_slivers()}) {
        const PathCase on(soup);
        std::mt19937_64 random(6);
        for (size_t i = 0; i < 150; ++i) {
            const auto a = random_point(on.soup, random, 3), b = random_point(on.soup, random, 3);
            float expected = 0;
            REQUIRE(geoidx_query_sssd(on.query.get(), id_at(on.soup, a), id_at(on.soup, b), &expected) ==
                    GEOIDX_OK);
            CHECK(on.sssd(a, b) == expected);
            const uint32_t id = id_at(on.soup, a);
            std::vector<float> whole(on.soup.vertex_count());
            REQUIRE(geoidx_query_msad(on.query.get(), &id, 1, whole.data(), on.soup.vertex_count()) ==
                    GEOIDX_OK);
            CHECK(field(on, {&a, 1}) == whole);
        }
    }
}

TEST_CASE("points: on a plane, fields are exact for what a point sees around it, in whatever leaf") {
    constexpr uint32_t CELLS = 30;
    for (const uint32_t engine : {GEOIDX_ENGINE_OVERLAY, GEOIDX_ENGINE_GRAPH}) {
        CAPTURE(engine);
        auto options = path_options(engine);
        options.level_count = 2;
        options.patches[0] = options.patches[1] = 5;
        const PathCase on(jittered_grid(CELLS, 4), options);
        std::mt19937_64 random(3);
        for (size_t i = 0; i < 300; i += sparse(1)) {
            const auto source = random_point(on.soup, random, 0);
            const auto distances = field(on, {&source, 1});
            size_t seen = 0;
            for (uint32_t v = 0; v < on.soup.vertex_count(); ++v) {
                const double straight = (on.soup.positions[v] - on.position(source)).norm();
                if (straight > 1.2 / CELLS) continue;
                CHECK(std::abs(double{distances[v]} / straight - 1) < 1e-6);
                ++seen;
            }
            CHECK(seen > 0);
        }
    }
}

TEST_CASE("points: fields from one point are no shorter than the line in space to what it sees") {
    for (const uint32_t engine : {GEOIDX_ENGINE_OVERLAY, GEOIDX_ENGINE_GRAPH}) {
        CAPTURE(engine);
        const PathCase on(bumpy_sphere(3, 5), path_options(engine));
        std::mt19937_64 random(8);
        for (uint32_t t = 0; t < on.soup.triangles.size(); t += sparse(1)) {
            auto source = random_point(on.soup, random, t % 2 * 2); // also on edges
            source.triangle = t;
            const std::set<uint32_t> own(on.soup.triangles[t].begin(), on.soup.triangles[t].end());
            const float offset = static_cast<float>(t % 3);
            const auto distances = field(on, {&source, 1}, &offset);
            for (const auto& corners : on.soup.triangles) {
                if (std::ranges::count_if(corners, [&](uint32_t v) { return own.contains(v); }) < 2) continue;
                for (const uint32_t v : corners) {
                    const double chord = (on.soup.positions[v] - on.position(source)).norm();
                    CHECK(double{distances[v] - offset} >= chord - 1e-6 * (chord + double{offset}));
                }
            }
        }
    }
}

TEST_CASE("points: near a vertex they are about as far from the others of its measured pairs as it is" *
          doctest::skip(SANITIZED)) {
    Soup soup = grid(40, 40, 40, 40);
    std::mt19937_64 random(5);
    raise_at_random(soup, random);
    const PathCase on(soup, path_options());
    const Index& index = on.index->index;
    const MeasuredPairs& pairs = std::get<OverlayIndex>(index.engine).measured;
    const auto around = triangles_around_vertices(soup);
    size_t count = 0;
    for (uint32_t id = 0; id < soup.vertex_count(); ++id) {
        const auto source = point_near(soup, random, id, around[id].front(), 1e-3);
        const double away = (on.position(source) - soup.positions[id]).norm();
        const float offset = 0.5f;
        const auto distances = field(on, {&source, 1}, &offset);
        for (const auto& [number, distance] : pairs.of(index.number_of_id[id])) {
            const auto other = static_cast<size_t>(std::ranges::find(index.number_of_id, number) -
                                                   index.number_of_id.begin());
            CHECK(std::abs(double{distances[other]} - double{offset} - double{distance}) <
                  away + 1.01 * LARGEST_ROUNDING * double{distance});
            ++count;
        }
    }
    CHECK(count > 50);
}

TEST_CASE("points: bad input is refused by name") {
    const PathCase on(torus(10, 8, 1, 0.4)), other(torus(10, 8, 1, 0.5));
    geoidx_surface_point fine{0, 0, {1, 0, 0}}, bad{0, 0, {2, -1, 0}};
    float distance = 0;
    const float negative = -1;
    std::vector<float> distances(on.soup.vertex_count());
    const auto msad = [&](const geoidx_surface_point* sources, uint32_t count, const float* offsets,
                          uint32_t room) {
        return geoidx_query_point_msad(on.query.get(), on.surface.get(), sources, count, offsets,
                                       distances.data(), room);
    };
    check_refused(geoidx_query_point_sssd(on.query.get(), on.surface.get(), &fine, &bad, &distance),
                  GEOIDX_ERROR_INVALID_ARGUMENT, "target has the weight");
    check_refused(geoidx_query_point_sssd(on.query.get(), other.surface.get(), &fine, &fine, &distance),
                  GEOIDX_ERROR_MESH_MISMATCH, "another mesh");
    check_refused(geoidx_query_point_sssd(on.query.get(), nullptr, &fine, &fine, &distance),
                  GEOIDX_ERROR_INVALID_ARGUMENT, "surface is NULL");
    check_refused(msad(&bad, 1, nullptr, on.soup.vertex_count()), GEOIDX_ERROR_INVALID_ARGUMENT, "source 0");
    check_refused(msad(&fine, 0, nullptr, on.soup.vertex_count()), GEOIDX_ERROR_INVALID_ARGUMENT,
                  "no source");
    check_refused(msad(&fine, 1, &negative, on.soup.vertex_count()), GEOIDX_ERROR_INVALID_ARGUMENT, "offset");
    check_refused(msad(&fine, 1, nullptr, 3), GEOIDX_ERROR_INVALID_ARGUMENT, "distance_count");
}
