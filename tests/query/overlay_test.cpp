// The overlay engine against the metric itself.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "tests/query/query_cases.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

namespace {

// The zoo with tables that are all the metric's own, and with tables that are put together. With a sanitizer,
// those have one level and these have three.
std::vector<QueryCase> overlay_cases(uint32_t metric) {
    std::vector<QueryCase> cases;
    for (const auto& [name, mesh] : mesh_zoo())
        for (uint32_t levels : {1u, 3u})
            for (uint32_t exact_vertices : {1u, 1000000u}) {
                if (SANITIZED && (levels == 3) == (exact_vertices > 1)) continue;
                cases.push_back({name + ", overlay, metric " + std::to_string(metric) + ", " +
                                     std::to_string(levels) + " levels, exact to " +
                                     std::to_string(exact_vertices),
                                 mesh, overlay_options(metric, levels, exact_vertices)});
            }
    return cases;
}

double longest(const std::vector<double>& distances) {
    double longest = 0;
    for (double d : distances)
        if (std::isfinite(d)) longest = std::max(longest, d);
    return longest;
}

// Equal where there is no path.
bool is_within(double rounding, double answer, double expected) {
    return std::isfinite(expected) ? std::abs(answer - expected) <= rounding : answer == expected;
}

constexpr uint32_t PLANE_SIDE = SANITIZED ? 120 : 200;

const TestMesh& large_plane() {
    static const TestMesh mesh = grid(PLANE_SIDE, PLANE_SIDE, 0.25);
    return mesh;
}

// An index of the plane with long borders, some pieces of which belong to patches of all levels.
const geoidx* index_with_long_borders() {
    static const auto index = [] {
        auto options = options_of_plane(large_plane(), {2, 8, 8});
        options.engine = GEOIDX_ENGINE_OVERLAY;
        options.exact_vertices = 1;
        return build(large_plane(), options);
    }();
    return index.get();
}

}

// Along edges every path crosses borders at vertices, so that nothing but the codes is rounded: a hop adds at
// most half a quantum, and a quantum is 1/32766 of a table's longest distance.
TEST_CASE("overlay: distances along edges are the metric's, but for the codes" * doctest::skip(SANITIZED)) {
    for (const QueryCase& test : overlay_cases(GEOIDX_METRIC_EDGES)) {
        CAPTURE(test.name);
        const uint32_t count = test.mesh.vertex_count();
        const geoidx* index = index_of(test);
        const auto metric = solver(test.mesh, test.options);
        uint64_t wrong = 0;
        for (uint32_t source : {0u, count / 3, count - 1}) {
            const auto expected = metric_distances(metric.get(), source, count);
            const double rounding = 1e-3 * longest(expected);
            const auto field = msad(index, source, count);
            for (uint32_t target = 0; target < count; ++target) {
                const double pair = double{sssd(index, source, target)};
                for (double answer : {double{field[target]}, pair})
                    wrong += !is_within(rounding, answer, expected[target]);
            }
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("overlay: a vertex far from all borders finds its way as MSAD does" * doctest::skip(SANITIZED)) {
    constexpr uint32_t SIDE = 40, TIP = SIDE / 2 * (SIDE + 1), COUNT = SIDE * SIDE;
    TestMesh mesh = grid(SIDE, SIDE);
    mesh.positions[3 * TIP + 2] = 3000; // a needle: far longer than the mesh is wide
    for (uint32_t metric : {GEOIDX_METRIC_EDGES, GEOIDX_METRIC_EXACT}) {
        CAPTURE(metric);
        const auto index = shared_index(mesh, overlay_options(metric, 3, 400));
        const auto field = msad(index.get(), TIP, COUNT);
        uint64_t wrong = 0;
        for (uint32_t target = 0; target < COUNT; ++target) {
            const double difference = double{sssd(index.get(), TIP, target)} - double{field[target]};
            wrong += std::abs(difference) > 0.5; // half an edge; the needle's own code is 0.1 long
        }
        CHECK(wrong == 0);
    }
}

// Samples of these borders are farther apart than these vertices.
TEST_CASE("overlay: near vertices find their way across a large border" * doctest::skip(SANITIZED)) {
    Differences errors;
    for (uint32_t source = 0; source < large_plane().vertex_count(); source += 3)
        for (uint32_t right = 0; right <= 3; ++right)
            for (uint32_t up = right == 0; up <= 3; ++up) {
                if (source % PLANE_SIDE + right >= PLANE_SIDE || source / PLANE_SIDE + up >= PLANE_SIDE)
                    continue;
                const uint32_t target = source + right + up * PLANE_SIDE;
                errors.add(double{sssd(index_with_long_borders(), source, target)},
                           large_plane().straight(source, target));
            }
    CHECK(errors.reached_wrongly == 0);
    CHECK(errors.mean() < 2e-3); // entries are rounded to 1/64 edge, and pairs are 1 to 4 edges apart
    CHECK(errors.largest < 0.2);
}

// Without labels a path climbs over the borders of all levels.
TEST_CASE("overlay: far vertices find their way over borders that have pieces in common" *
          doctest::skip(SANITIZED)) {
    const IndexHandle opened = without_labels(index_with_long_borders());
    Differences errors;
    std::mt19937 random(7);
    const auto any_vertex = [&] { return static_cast<uint32_t>(random() % large_plane().vertex_count()); };
    for (uint32_t i = 0; i < 400000; ++i) {
        const uint32_t source = any_vertex(), target = any_vertex();
        const double straight = large_plane().straight(source, target);
        if (straight > 5) errors.add(double{sssd(opened.get(), source, target)}, straight);
    }
    CHECK(errors.reached_wrongly == 0);
    CHECK(errors.mean() < 2e-3);
    CHECK(errors.largest < 0.02);
}

// A patch around a whole part has an empty border. How long the borders on both sides are decides how pairs
// look for ways.
TEST_CASE("overlay: pairs of separate parts have no path, over borders of any length") {
    for (const uint32_t columns : {30u, 60u, 100u, 140u}) {
        CAPTURE(columns);
        TestMesh mesh = grid(50, 50);
        const uint32_t first = mesh.vertex_count();
        const TestMesh second = grid(columns, 50);
        for (size_t i = 0; i < second.positions.size(); ++i)
            mesh.positions.push_back(second.positions[i] + (i % 3 == 0 ? 1000 : 0));
        for (const uint32_t corner : second.triangles) mesh.triangles.push_back(corner + first);
        auto options = overlay_options(GEOIDX_METRIC_CALLBACK, 3, 1);
        options.patches[0] = 3;
        options.patches[1] = options.patches[2] = 4;
        options.metric_flags = GEOIDX_METRIC_UNFOLDABLE;
        options.metric_user = &mesh;
        options.metric_callback = [](void* user, uint32_t source, const uint32_t* targets, uint32_t count,
                                     double* distances) {
            for (uint32_t i = 0; i < count; ++i)
                distances[i] = static_cast<const TestMesh*>(user)->straight(source, targets[i]);
            return geoidx_status{GEOIDX_OK};
        };
        const auto built = build(mesh, options);
        const IndexHandle opened = without_labels(built.get());
        std::mt19937 random(3);
        uint32_t wrong = 0;
        Differences errors;
        for (uint32_t i = 0; i < 20000; i += sparse(1)) {
            const auto a = static_cast<uint32_t>(random() % first),
                       b = first + static_cast<uint32_t>(random() % (mesh.vertex_count() - first)),
                       c = static_cast<uint32_t>(random() % first);
            for (const geoidx* index : std::initializer_list<const geoidx*>{built.get(), opened.get()}) {
                wrong += sssd(index, a, b) != INFINITY;
                wrong += sssd(index, b, a) != INFINITY;
                errors.add(double{sssd(index, a, c)}, mesh.straight(a, c));
            }
        }
        CHECK(wrong == 0);
        CHECK(errors.reached_wrongly == 0);
        CHECK(errors.mean() < 2e-3);
    }
}

// Borders here are many short chains. Vertices side by side on the tubes may be far from each other in the
// order of a border.
TEST_CASE("overlay: pairs on a lattice of tubes are as far apart as in a field" * doctest::skip(SANITIZED)) {
    const TestMesh mesh = lattice(3);
    const uint32_t count = mesh.vertex_count();
    auto options = overlay_options(GEOIDX_METRIC_EXACT, 3, 400);
    options.patches[0] = options.patches[1] = options.patches[2] = 4;
    const auto index = shared_index(mesh, options);
    Differences differences;
    for (uint32_t source = 0; source < count; source += 40) {
        const auto field = msad(index.get(), source, count);
        for (uint32_t target = 0; target < count; ++target)
            differences.add(double{sssd(index.get(), source, target)}, double{field[target]});
    }
    CHECK(differences.reached_wrongly == 0);
    CHECK(differences.largest < 0.06);
}

// A path between near vertices may pass a jagged border far from the border vertex that is the least detour.
TEST_CASE("overlay: near vertices in different leaves are nearly as far apart as the metric says" *
          doctest::skip(SANITIZED)) {
    const TestMesh mesh = torus(60, 30);
    const uint32_t count = mesh.vertex_count();
    auto options = overlay_options(GEOIDX_METRIC_EXACT, 3, 400);
    options.patches[0] = options.patches[1] = options.patches[2] = 4;
    const auto index = shared_index(mesh, options);
    const auto exact = solver(mesh, options);
    const double near = info_of(index.get()).bounding_box_diagonal / 10;
    Differences field_errors, pair_errors;
    for (uint32_t source = 0; source < count; source += 19) {
        const auto expected = metric_distances(exact.get(), source, count);
        const auto field = msad(index.get(), source, count);
        for (uint32_t target = 0; target < count; ++target) {
            if (expected[target] > near) continue;
            field_errors.add(double{field[target]}, expected[target]);
            pair_errors.add(double{sssd(index.get(), source, target)}, expected[target]);
        }
    }
    CHECK(field_errors.count > 3000);
    CHECK(field_errors.reached_wrongly + pair_errors.reached_wrongly == 0);
    CHECK(field_errors.largest < 0.01);
    CHECK(pair_errors.largest < 0.01);
}

TEST_CASE("overlay: costs next to nothing") {
    const TestMesh mesh = hills(18, 17);
    std::vector<uint32_t> vertices;
    std::vector<double> costs;
    for (size_t t = 0; t < mesh.triangles.size(); t += 3)
        for (size_t k = 0; k < 3; ++k) {
            vertices.insert(vertices.end(), {mesh.triangles[t + k], mesh.triangles[t + (k + 1) % 3]});
            costs.push_back((t + k) % 3 == 0 ? 0 : 1e-36);
        }
    auto options = overlay_options(GEOIDX_METRIC_EDGES, 3, 400);
    options.edge_cost_count = static_cast<uint32_t>(costs.size());
    options.edge_cost_vertices = vertices.data();
    options.edge_costs = costs.data();
    const auto index = shared_index(mesh, options);
    const auto metric = solver(mesh, options);
    const uint32_t count = mesh.vertex_count();
    uint64_t wrong = 0;
    for (uint32_t source : {0u, count / 2}) {
        const auto expected = metric_distances(metric.get(), source, count);
        for (uint32_t target = 0; target < count; ++target)
            wrong += !is_within(1e-36, double{sssd(index.get(), source, target)}, expected[target]);
    }
    CHECK(wrong == 0);
}

TEST_CASE("overlay: several sources are the nearest of them") {
    for (const QueryCase& test : overlay_cases(GEOIDX_METRIC_EDGES)) {
        CAPTURE(test.name);
        const uint32_t count = test.mesh.vertex_count();
        const geoidx* index = index_of(test);
        const auto metric = solver(test.mesh, test.options);
        const std::vector<uint32_t> sources{count / 2, 0, count - 1, count / 2};
        const auto expected = metric_distances(metric.get(), sources, count);
        const auto field = msad(index, sources, count);
        uint64_t wrong = 0;
        const double rounding = 1e-3 * longest(expected);
        for (uint32_t target = 0; target < count; ++target)
            wrong += !is_within(rounding, double{field[target]}, expected[target]);
        CHECK(wrong == 0);
    }
}

// The straight lines of a plane cross every border between two vertices: over vertices only they would be 0.1
// % too long on average, over the middles of segments, too, a quarter of that. The hills are coarse.
TEST_CASE("overlay: exact distances, crossing borders between vertices" * doctest::skip(SANITIZED)) {
    for (uint32_t exact_vertices : {1u, 1000000u})
        for (const auto& [mesh, most] :
             {std::pair{grid(40, 40, 0.25), 3e-4}, {hills(40, 40), 2e-3}, {torus(60, 30), 1e-3}}) {
            CAPTURE(exact_vertices);
            const uint32_t count = mesh.vertex_count();
            const auto options = overlay_options(GEOIDX_METRIC_EXACT, 3, exact_vertices);
            const auto index = shared_index(mesh, options);
            const auto exact = solver(mesh, options);
            Differences field_errors, pair_errors, disagreement;
            for (uint32_t source : {0u, count / 3, count / 2, count - 1}) {
                const auto expected = metric_distances(exact.get(), source, count);
                const auto field = msad(index.get(), source, count);
                for (uint32_t target = 0; target < count; ++target) {
                    const double pair = double{sssd(index.get(), source, target)};
                    field_errors.add(double{field[target]}, expected[target]);
                    pair_errors.add(pair, expected[target]);
                    disagreement.add(pair, double{field[target]});
                }
            }
            CHECK(field_errors.reached_wrongly == 0);
            CHECK(pair_errors.reached_wrongly == 0);
            CHECK(field_errors.mean() < most);
            CHECK(pair_errors.mean() < most);
            CHECK(field_errors.largest < 0.1);
            CHECK(disagreement.mean() < 5e-4);
        }
}

// All that is known of the way from one to the other is that vertex, whose table has no distance but 0.
TEST_CASE("overlay: two surfaces that share one vertex") {
    TestMesh mesh = grid(8, 8);
    const TestMesh other = grid(8, 8);
    const uint32_t shared = mesh.vertex_count() - 1, first = mesh.vertex_count() - 1;
    for (uint32_t v = 1; v < other.vertex_count(); ++v)
        mesh.add_vertex(7 + other.positions[3 * v], 7 + other.positions[3 * v + 1], 0);
    for (size_t t = 0; t < other.triangles.size(); t += 3) {
        const auto moved = [&](size_t k) {
            return other.triangles[t + k] == 0 ? shared : first + other.triangles[t + k];
        };
        mesh.add_triangle(moved(0), moved(1), moved(2));
    }
    const uint32_t count = mesh.vertex_count();
    for (uint32_t levels : {1u, 2u, 3u}) {
        CAPTURE(levels);
        auto options = overlay_options(GEOIDX_METRIC_EXACT, levels, 400);
        options.patches[0] = 2;
        const auto index = shared_index(mesh, options);
        const QueryHandle query = query_of(index.get());
        Differences pairs, prepared;
        for (uint32_t source = 0; source <= shared; ++source) {
            require_success(geoidx_query_prepare(query.get(), source));
            for (uint32_t target = shared; target < count; ++target) {
                const double expected = mesh.straight(source, shared) + mesh.straight(shared, target);
                float distance = 0;
                require_success(geoidx_query_prepared(query.get(), &target, 1, &distance));
                prepared.add(double{distance}, expected);
                pairs.add(double{sssd(index.get(), source, target)}, expected);
            }
        }
        for (const Differences& errors : {pairs, prepared}) {
            CHECK(errors.reached_wrongly == 0);
            CHECK(errors.largest < 0.1);
        }
    }
}

// Borders end at the rim of the mesh, which is where they lose a segment most easily.
TEST_CASE("overlay: straight lines on a plane, from everywhere to everywhere" * doctest::skip(SANITIZED)) {
    const TestMesh mesh = grid(40, 30, 0.25);
    const uint32_t count = mesh.vertex_count();
    for (uint32_t levels : {0u, 3u}) {
        CAPTURE(levels);
        const auto index = shared_index(mesh, overlay_options(GEOIDX_METRIC_EXACT, levels, 400));
        Differences errors;
        for (uint32_t source = 0; source < count; ++source) {
            const auto field = msad(index.get(), source, count);
            for (uint32_t target = 0; target < count; ++target)
                errors.add(double{field[target]}, mesh.straight(source, target));
        }
        CHECK(errors.reached_wrongly == 0);
        CHECK(errors.mean() < 3e-4);
        CHECK(errors.largest < 0.1);
    }
}

// A plane that is folded into steps: distances along it stay those of the plane.
TEST_CASE("overlay: on a small staircase, distances of the plane that it is folded from") {
    constexpr uint32_t STEPS = 40, WIDTH = 10;
    const TestMesh plane = grid(STEPS, WIDTH);
    TestMesh stairs = plane;
    for (size_t i = 0; i < stairs.positions.size(); i += 3) {
        const double along = plane.positions[i];
        stairs.positions[i] = std::ceil(along / 2);
        stairs.positions[i + 2] = std::floor(along / 2);
    }
    const auto index = shared_index(stairs, default_options());
    Differences errors;
    for (uint32_t source = 0; source < plane.vertex_count(); source += 7) {
        const auto field = msad(index.get(), source, plane.vertex_count());
        for (uint32_t target = 0; target < plane.vertex_count(); ++target)
            errors.add(double{field[target]}, plane.straight(source, target));
    }
    CHECK(errors.reached_wrongly == 0);
    CHECK(errors.mean() < 1e-4);
    CHECK(errors.largest < 5e-3);
}

// The same distances, told to be locally Euclidean or not.
TEST_CASE("overlay: only a metric that unfolds crosses borders between vertices" * doctest::skip(SANITIZED)) {
    const TestMesh mesh = grid(40, 40, 0.25);
    const uint32_t count = mesh.vertex_count();
    auto options = overlay_options(GEOIDX_METRIC_EXACT, 3, 1000000);
    const auto exact = solver(mesh, options);
    options.metric = GEOIDX_METRIC_CALLBACK;
    options.threads = 1;
    options.metric_user = exact.get();
    options.metric_callback = [](void* user, uint32_t source, const uint32_t* targets, uint32_t target_count,
                                 double* distances) {
        return geoidx_solver_distances(static_cast<geoidx_solver*>(user), &source, 1, targets, target_count,
                                       distances);
    };
    Differences errors[2];
    uint64_t too_short = 0;
    double at_vertices = 0; // as the builder measured it
    for (uint32_t flags : {0u, uint32_t{GEOIDX_METRIC_UNFOLDABLE}}) {
        options.metric_flags = flags;
        const auto index = build(mesh, options);
        const geoidx_info info = info_of(index.get());
        if (flags)
            at_vertices = info.error_mean_at_vertices;
        else
            CHECK(info.error_mean_at_vertices == info.error_mean);
        for (uint32_t source : {0u, count / 3, count / 2, count - 1}) {
            const auto expected = metric_distances(exact.get(), source, count);
            const auto field = msad(index.get(), source, count);
            for (uint32_t target = 0; target < count; ++target) {
                errors[flags].add(double{field[target]}, expected[target]);
                too_short +=
                    flags == 0 && double{field[target]} < expected[target] - 1e-3 * longest(expected);
            }
        }
    }
    CHECK(too_short == 0);
    CHECK(errors[0].mean() > 5 * errors[GEOIDX_METRIC_UNFOLDABLE].mean());
    CHECK(at_vertices == doctest::Approx(errors[0].mean()).epsilon(0.3));
}

TEST_CASE("overlay: SSSD is symmetric bit for bit, MSAD is 0 at its sources" * doctest::skip(SANITIZED)) {
    for (const QueryCase& test : overlay_cases(GEOIDX_METRIC_EXACT)) {
        CAPTURE(test.name);
        const uint32_t count = test.mesh.vertex_count();
        const auto index = shared_index(test.mesh, test.options);
        uint64_t wrong = 0;
        for (uint32_t i = 0; i < 200; ++i) {
            const uint32_t a = (i * 131 + 1) % count, b = (i * 37 + 5) % count;
            const float there = sssd(index.get(), a, b), back = sssd(index.get(), b, a);
            wrong += std::memcmp(&there, &back, sizeof there) != 0 || (a == b && there != 0);
        }
        for (uint32_t source : {0u, count / 2, count - 1})
            wrong += msad(index.get(), source, count)[source] != 0;
        CHECK(wrong == 0);
    }
}

TEST_CASE("overlay: threads, saving and opening change no bit" * doctest::skip(SANITIZED)) {
    for (const TestMesh& mesh : {hills(20, 19), components_and_unused()})
        for (uint32_t metric : {GEOIDX_METRIC_EXACT, GEOIDX_METRIC_EDGES}) {
            auto options = overlay_options(metric, 3, 30);
            options.threads = 1;
            const auto built = shared_index(mesh, options);
            const Bytes bytes = save(built.get());
            options.threads = 5;
            CHECK(save(build(mesh, options).get()) == bytes);
            CHECK(geoidx_verify(bytes.data(), bytes.size(), nullptr, nullptr) == GEOIDX_OK);
            const auto opened = open(bytes);
            CHECK(save(opened.get()) == bytes);
            const geoidx_info before = info_of(built.get()), after = info_of(opened.get());
            CHECK(std::memcmp(&before, &after, sizeof before) == 0);
            CHECK(after.engine == GEOIDX_ENGINE_OVERLAY);
            const uint32_t count = mesh.vertex_count();
            for (uint32_t source = 0; source < count; source += 17) {
                CHECK(msad(built.get(), source, count) == msad(opened.get(), source, count));
                CHECK(sssd(built.get(), source, count / 2) == sssd(opened.get(), source, count / 2));
            }
        }
}

TEST_CASE("overlay: an engine that is none is refused") {
    auto options = build_options();
    options.engine = 2;
    const TestMesh mesh = grid(3, 3);
    const geoidx_mesh view = mesh.view();
    geoidx* index = nullptr;
    CHECK(geoidx_build(&view, &options, &index) == GEOIDX_ERROR_INVALID_ARGUMENT);
    CHECK(std::string(geoidx_last_error()).find("engine 2") != std::string::npos);
}
