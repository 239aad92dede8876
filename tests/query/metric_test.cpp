// Queries against the metric itself, computed without an index.

#include <cmath>
#include <random>

#include "src/capi/handles.h"
#include "tests/query/query_cases.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// The leaves that hold a vertex, inside or on their border.
std::vector<uint32_t> leaves_of(const Numbering& numbering, uint32_t number) {
    std::vector<uint32_t> leaves;
    for (uint32_t leaf = numbering.first_leaf(); leaf < numbering.patch_count(); ++leaf) {
        const auto border = numbering.border_of(leaf);
        const uint32_t first = numbering.first_internal(leaf);
        if (std::ranges::count(border, number) > 0 ||
            (number >= first && number < first + numbering.internal_size(leaf)))
            leaves.push_back(leaf);
    }
    return leaves;
}

bool share_a_leaf(const Numbering& numbering, uint32_t a, uint32_t b) {
    const auto of_a = leaves_of(numbering, a), of_b = leaves_of(numbering, b);
    return std::ranges::find_first_of(of_a, of_b) != of_a.end();
}

std::vector<uint32_t> random_ids(const TestMesh& mesh, uint32_t count, uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<uint32_t> ids;
    for (uint32_t i = 0; i < count; ++i) ids.push_back(static_cast<uint32_t>(random() % mesh.vertex_count()));
    return ids;
}

// What holds of any answer: no NaN, reachable exactly where the metric says so, not below it.
bool is_sound(float answer, double metric) {
    if (std::isinf(metric) || metric == 0) return double{answer} == metric;
    return std::isfinite(answer) && double{answer} >= metric * (1 - ROUNDING);
}

}

TEST_CASE("SSSD: sound, symmetric bit for bit, exact within a leaf") {
    for (const QueryCase& test : query_cases()) {
        CAPTURE(test.name);
        const geoidx* handle = index_of(test);
        const auto metric = solver(test.mesh, test.options);
        const Index& prepared = handle->index;
        uint64_t unsound = 0, asymmetric = 0, inexact = 0, of_one_leaf = 0;
        for (uint32_t a : random_ids(test.mesh, 6, 1)) {
            const auto exact = metric_distances(metric.get(), a, test.mesh.vertex_count());
            for (uint32_t b = 0; b < test.mesh.vertex_count(); ++b) {
                const float there = sssd(handle, a, b), back = sssd(handle, b, a);
                asymmetric += std::bit_cast<uint32_t>(there) != std::bit_cast<uint32_t>(back);
                unsound += !is_sound(there, exact[b]);
                const uint32_t from = prepared.number_of_id[a], to = prepared.number_of_id[b];
                if (from == NONE || to == NONE || a == b || !share_a_leaf(prepared.numbering(), from, to))
                    continue;
                ++of_one_leaf;
                inexact += std::abs(double{there} - exact[b]) > 2e-7 * exact[b];
            }
        }
        CHECK(unsound == 0);
        CHECK(asymmetric == 0);
        CHECK(inexact == 0);
        CHECK(of_one_leaf > 0);
    }
}

TEST_CASE("SSSD is symmetric for all pairs") {
    for (uint32_t levels : {1u, 2u, 3u}) {
        const TestMesh mesh = hills(13, 12);
        const auto index = shared_index(mesh, build_options(GEOIDX_METRIC_EXACT, levels));
        const uint32_t count = mesh.vertex_count();
        std::vector<uint32_t> pairs;
        for (uint32_t a = 0; a < count; ++a)
            for (uint32_t b = 0; b < count; ++b) pairs.insert(pairs.end(), {a, b});
        std::vector<float> distances(size_t{count} * count, -1.0f);
        require_success(geoidx_sssd_batch(index.get(), pairs.data(), distances.size(), distances.data()));
        uint64_t asymmetric = 0, wrong_zero = 0;
        for (uint32_t a = 0; a < count; ++a)
            for (uint32_t b = 0; b < count; ++b) {
                const float there = distances[size_t{a} * count + b], back = distances[size_t{b} * count + a];
                asymmetric += std::bit_cast<uint32_t>(there) != std::bit_cast<uint32_t>(back);
                wrong_zero += (there == 0) != (a == b);
            }
        CHECK(asymmetric == 0);
        CHECK(wrong_zero == 0);
    }
}

TEST_CASE("MSAD: sound, 0 at sources, of several sources the minimum over single ones") {
    for (const QueryCase& test : query_cases()) {
        CAPTURE(test.name);
        const geoidx* handle = index_of(test);
        const auto metric = solver(test.mesh, test.options);
        const uint32_t count = test.mesh.vertex_count();
        auto sources = random_ids(test.mesh, 4, 2);
        sources.push_back(sources[1]); // twice the same
        std::vector<float> smallest(count, INFINITE);
        uint64_t unsound = 0, differs = 0;
        for (uint32_t source : sources) {
            const auto answers = msad(handle, source, count);
            const auto exact = metric_distances(metric.get(), source, count);
            CHECK(answers[source] == 0);
            for (uint32_t v = 0; v < count; ++v) {
                unsound += !is_sound(answers[v], exact[v]);
                smallest[v] = std::min(smallest[v], answers[v]);
            }
        }
        const auto together = msad(handle, sources, count);
        const auto exact = metric_distances(metric.get(), sources, count);
        for (uint32_t v = 0; v < count; ++v) {
            unsound += !is_sound(together[v], exact[v]);
            // The phases are sums and minima, so the minimum over sources may be taken before or after them.
            const bool same = together[v] == smallest[v] || std::abs(together[v] - smallest[v]) <=
                                                                static_cast<float>(ROUNDING) * smallest[v];
            differs += !same;
        }
        CHECK(unsound == 0);
        CHECK(differs == 0);
    }
}

// Of the edge metric a shortest path leaves a patch at a border vertex, so nothing is lost at any level.
TEST_CASE("the edge metric without pruning is exact: MSAD at all levels, SSSD at one") {
    for (const QueryCase& test : query_cases()) {
        if (test.options.metric != GEOIDX_METRIC_EDGES || test.options.delta != 0) continue;
        CAPTURE(test.name);
        const geoidx* handle = index_of(test);
        const auto metric = solver(test.mesh, test.options);
        const uint32_t count = test.mesh.vertex_count();
        uint64_t inexact = 0;
        for (uint32_t a : random_ids(test.mesh, 5, 3)) {
            const auto answers = msad(handle, a, count);
            const auto exact = metric_distances(metric.get(), a, count);
            for (uint32_t b = 0; b < count; ++b) {
                const auto differs = [&](double answer) {
                    return answer != exact[b] && !(std::abs(answer - exact[b]) <= ROUNDING * exact[b]);
                };
                inexact += differs(double{answers[b]});
                if (test.options.level_count == 1) inexact += differs(double{sssd(handle, a, b)});
            }
        }
        CHECK(inexact == 0);
    }
}

TEST_CASE("random edge costs, zero among them: MSAD is exact") {
    const TestMesh mesh = hills(18, 17);
    std::mt19937 random(5);
    std::vector<uint32_t> vertices;
    std::vector<double> costs;
    for (size_t t = 0; t < mesh.triangles.size(); t += 3)
        for (size_t k = 0; k < 3; ++k) {
            vertices.insert(vertices.end(), {mesh.triangles[t + k], mesh.triangles[t + (k + 1) % 3]});
            costs.push_back(random() % 8 == 0 ? 0 : static_cast<double>(random() % 10000) / 1000);
        }
    for (uint32_t levels : {1u, 3u}) {
        auto options = build_options(GEOIDX_METRIC_EDGES, levels);
        options.edge_cost_count = static_cast<uint32_t>(costs.size());
        options.edge_cost_vertices = vertices.data();
        options.edge_costs = costs.data();
        const auto handle = shared_index(mesh, options);
        const auto metric = solver(mesh, options);
        uint64_t inexact = 0, below = 0;
        for (uint32_t a : {0u, 77u, 200u}) {
            const auto answers = msad(handle.get(), a, mesh.vertex_count());
            const auto exact = metric_distances(metric.get(), a, mesh.vertex_count());
            for (uint32_t b = 0; b < mesh.vertex_count(); ++b) {
                inexact += !(std::abs(double{answers[b]} - exact[b]) <= ROUNDING * exact[b]);
                below += double{sssd(handle.get(), a, b)} < exact[b] * (1 - ROUNDING);
            }
        }
        CHECK(inexact == 0);
        CHECK(below == 0);
    }
}

TEST_CASE("on a plane the distance is the straight line, with a small mean error") {
    const TestMesh mesh = grid(30, 25, 0.25);
    for (uint32_t levels : {1u, 2u}) {
        const auto index = shared_index(mesh, build_options(GEOIDX_METRIC_EXACT, levels));
        double sum = 0;
        uint64_t below = 0, count = 0;
        for (uint32_t a : random_ids(mesh, 8, 4)) {
            const auto answers = msad(index.get(), a, mesh.vertex_count());
            for (uint32_t b = 0; b < mesh.vertex_count(); ++b) {
                if (a == b) continue;
                const double error = double{answers[b]} / mesh.straight(a, b) - 1;
                below += error < -ROUNDING;
                sum += error;
                ++count;
            }
        }
        CHECK(below == 0);
        CHECK(sum / static_cast<double>(count) < 0.03); // the detour over border vertices one unit apart
        const geoidx_info info = info_of(index.get());
        CHECK(info.error_mean < 0.03);
        CHECK(info.error_signed_mean >= -ROUNDING);
    }
}

namespace {

// The relative errors of MSAD on a plane from one vertex.
struct ErrorsFrom {
    double sum = 0, signed_sum = 0, max = 0;
};

ErrorsFrom errors_from(const geoidx* index, const TestMesh& plane, uint32_t source) {
    const auto answers = msad(index, source, plane.vertex_count());
    ErrorsFrom errors;
    for (uint32_t b = 0; b < plane.vertex_count(); ++b) {
        if (b == source) continue;
        const double error = double{answers[b]} / plane.straight(source, b) - 1;
        errors.sum += std::abs(error);
        errors.signed_sum += error;
        errors.max = std::max(errors.max, std::abs(error));
    }
    return errors;
}

}

TEST_CASE("the measured error in the info is that of MSAD") {
    // One leaf: the error is float rounding.
    const TestMesh small = grid(6, 6, 0.2);
    auto options = build_options(GEOIDX_METRIC_EXACT, 1);
    options.patches[0] = 1;
    CHECK(info_of(build(small, options).get()).error_max < 2e-7);

    const TestMesh mesh = grid(16, 15, 0.2);
    const uint32_t count = mesh.vertex_count();
    for (uint32_t engine : {GEOIDX_ENGINE_GRAPH, GEOIDX_ENGINE_OVERLAY}) {
        CAPTURE(engine);
        options = build_options(GEOIDX_METRIC_EXACT, 2);
        options.engine = engine;
        const auto index = shared_index(mesh, options);
        const geoidx_info info = info_of(index.get());
        ErrorsFrom all;
        double largest_of_all = 0;
        uint32_t with_less = 0;
        for (uint32_t a = 0; a < count; ++a) {
            const ErrorsFrom errors = errors_from(index.get(), mesh, a);
            all.sum += errors.sum;
            all.signed_sum += errors.signed_sum;
            with_less += errors.max <= info.error_max + 2 * ROUNDING;
            largest_of_all = std::max(largest_of_all, errors.max);
            for (uint32_t b = 0; b < a; ++b)
                largest_of_all = std::max(
                    largest_of_all, std::abs(double{sssd(index.get(), a, b)} / mesh.straight(a, b) - 1));
        }
        // The largest one is that of some pair, and hardly any source has a larger one. What 20 of 240
        // sources say of the mean is near that of all.
        CHECK(info.error_max <= largest_of_all + 2 * ROUNDING);
        CHECK(with_less >= 99 * count / 100);
        const double pairs = 1.0 * count * (count - 1);
        CHECK(info.error_mean == doctest::Approx(all.sum / pairs).epsilon(0.25));
        CHECK(std::abs(info.error_signed_mean - all.signed_sum / pairs) < 0.25 * all.sum / pairs);
        CHECK(info.error_mean < info.error_p99);
        CHECK(info.error_p99 <= info.error_p999);
        CHECK(info.error_p999 <= info.error_max);
    }
}

TEST_CASE("vertices that cannot be reached and vertices that no triangle uses") {
    const TestMesh mesh = components_and_unused(); // unused: 0, 183 and the last
    const uint32_t count = mesh.vertex_count(), last = count - 1;
    const uint32_t hill = 1, unused = 183, triangle = 184;
    const auto handle = shared_index(mesh, build_options(GEOIDX_METRIC_EXACT, 2));
    CHECK(info_of(handle.get()).welded_vertex_count == count - 3);
    CHECK(sssd(handle.get(), hill, triangle) == INFINITE);
    CHECK(sssd(handle.get(), triangle, hill) == INFINITE);
    CHECK(sssd(handle.get(), hill, unused) == INFINITE);
    CHECK(sssd(handle.get(), unused, last) == INFINITE);
    CHECK(sssd(handle.get(), unused, unused) == 0);
    CHECK(sssd(handle.get(), triangle, triangle + 2) == 4.0f);

    const auto from_unused = msad(handle.get(), unused, count);
    for (uint32_t v = 0; v < count; ++v) CHECK(from_unused[v] == (v == unused ? 0 : INFINITE));

    const uint32_t sources[] = {unused, triangle, unused};
    const auto from_both = msad(handle.get(), sources, count);
    CHECK(from_both[unused] == 0);
    CHECK(from_both[triangle + 1] == 3.0f);
    CHECK(from_both[triangle + 2] == 4.0f);
    for (uint32_t v = 0; v < unused; ++v) CHECK(from_both[v] == INFINITE);
    CHECK(from_both[last] == INFINITE);

    const auto metric = solver(mesh, build_options(GEOIDX_METRIC_EXACT, 2));
    const auto exact = metric_distances(metric.get(), sources, count);
    for (uint32_t v = 0; v < count; ++v)
        CHECK((exact[v] == from_both[v] || exact[v] == doctest::Approx(double{from_both[v]})));
}

TEST_CASE("equal positions are one vertex") {
    const uint32_t columns = 21, rows = 15;
    const TestMesh cut = seam(columns, rows), whole = grid(columns, rows, 0.2);
    const auto index = shared_index(cut, build_options(GEOIDX_METRIC_EXACT, 2));
    CHECK(info_of(index.get()).welded_vertex_count == whole.vertex_count());
    for (uint32_t y = 0; y < rows; ++y) {
        const uint32_t original = y * columns + columns / 2, copy = whole.vertex_count() + y;
        CHECK(sssd(index.get(), original, copy) == 0);
        CHECK(sssd(index.get(), copy, 0) == sssd(index.get(), original, 0));
        CHECK(msad(index.get(), copy, cut.vertex_count()) == msad(index.get(), original, cut.vertex_count()));
    }
}

// A vertex that no triangle uses before the mesh and one after it lie where a vertex of the mesh does, two
// more lie together elsewhere.
TEST_CASE("an unused vertex at the place of a used one is that one; unused ones together stay unreachable") {
    const TestMesh surface = hills(12, 11);
    for (const double apart : {0.0, 1e-6}) {
        TestMesh mesh;
        mesh.add_vertex(surface.positions[90] + apart, surface.positions[91], surface.positions[92]);
        append(mesh, surface, 0);
        const uint32_t before = 0, used = 1 + 30, corner = 1;
        const uint32_t after =
            mesh.add_vertex(surface.positions[90], surface.positions[91] + apart, surface.positions[92]);
        const uint32_t lost = mesh.add_vertex(50, 0, 0), beside = mesh.add_vertex(50 + apart, 0, 0);
        const uint32_t count = mesh.vertex_count();
        for (const uint32_t engine : {GEOIDX_ENGINE_GRAPH, GEOIDX_ENGINE_OVERLAY}) {
            CAPTURE(engine);
            auto options = build_options(GEOIDX_METRIC_EXACT, 2);
            options.engine = engine;
            options.weld_tolerance = 2 * apart;
            const auto index = shared_index(mesh, options);
            CHECK(info_of(index.get()).welded_vertex_count == surface.vertex_count());
            const auto metric = solver(mesh, options);
            for (const uint32_t unused : {before, after}) {
                CHECK(sssd(index.get(), unused, used) == 0);
                CHECK(sssd(index.get(), unused, before + after - unused) == 0);
                CHECK(sssd(index.get(), unused, corner) == sssd(index.get(), used, corner));
                CHECK(std::isfinite(sssd(index.get(), unused, corner)));
                CHECK(msad(index.get(), unused, count) == msad(index.get(), used, count));
                CHECK(metric_distances(metric.get(), unused, count) ==
                      metric_distances(metric.get(), used, count));
            }
            CHECK(sssd(index.get(), lost, beside) == INFINITE);
            CHECK(sssd(index.get(), lost, used) == INFINITE);
            for (uint32_t v = 0; v < count; ++v) {
                CHECK(msad(index.get(), lost, count)[v] == (v == lost ? 0 : INFINITE));
                CHECK(metric_distances(metric.get(), lost, count)[v] == (v == lost ? 0.0 : double{INFINITE}));
            }
        }
    }
}

TEST_CASE("geoidx_query_* answers as geoidx_* does, batch as single") {
    const TestMesh mesh = components_and_unused();
    const uint32_t count = mesh.vertex_count();
    const auto index = shared_index(mesh, build_options(GEOIDX_METRIC_EXACT, 2));
    geoidx_query* made = nullptr;
    require_success(geoidx_query_create(index.get(), &made));
    const QueryHandle query(made);
    const auto ids = random_ids(mesh, 60, 6);
    std::vector<float> batch(ids.size() / 2);
    require_success(geoidx_sssd_batch(index.get(), ids.data(), batch.size(), batch.data()));
    for (size_t i = 0; i < batch.size(); ++i) {
        const float single = sssd(index.get(), ids[2 * i], ids[2 * i + 1]);
        float own = -1;
        require_success(geoidx_query_sssd(query.get(), ids[2 * i], ids[2 * i + 1], &own));
        CHECK(own == single);
        CHECK(batch[i] == single);
        std::vector<float> distances(count);
        require_success(geoidx_query_msad(query.get(), &ids[i], 3, distances.data(), count));
        CHECK(distances == msad(index.get(), std::span(&ids[i], 3), count));
    }
}

// A border along which many ways are equally long, each of as many short entries as it has vertices: rounding
// them down hundreds of times must not pay.
TEST_CASE("the graph engine is not below the metric where borders have many short edges" *
          doctest::skip(SANITIZED)) {
    constexpr uint32_t COLUMNS = 7, ROWS = 301;
    TestMesh mesh = grid(COLUMNS, ROWS);
    for (size_t y = 1; y < mesh.positions.size(); y += 3) mesh.positions[y] *= 0.00012048;
    const auto options = build_options(GEOIDX_METRIC_EDGES, 1);
    const auto index = shared_index(mesh, options);
    const auto metric = solver(mesh, options);
    uint64_t below = 0, farther = 0;
    for (uint32_t a : {0u, 3u, COLUMNS * ROWS / 2}) {
        const auto exact = metric_distances(metric.get(), a, mesh.vertex_count());
        const auto answers = msad(index.get(), a, mesh.vertex_count());
        for (uint32_t b = 0; b < mesh.vertex_count(); ++b) {
            below += !is_sound(answers[b], exact[b]) || !is_sound(sssd(index.get(), a, b), exact[b]);
            farther += exact[b] > 2; // where the short edges are far below the rounding of a sum
        }
    }
    CHECK(below == 0);
    CHECK(farther > 1000);
}

// Distances up to 3e38 are floats; a query must not lose them, nor very short ones, on its way.
TEST_CASE("very large and very small meshes") {
    for (const auto& [engine, shortened] :
         {std::pair{GEOIDX_ENGINE_GRAPH, ROUNDING}, {GEOIDX_ENGINE_OVERLAY, 0.05}})
        for (double scale : {1e-30, 1e-20, 1e-18, 1e-12, 1e12, 1e18, 1e20, 1e30}) {
            CAPTURE(scale);
            TestMesh mesh = grid(12, 11, 0.2);
            const TestMesh unit = mesh;
            for (double& coordinate : mesh.positions) coordinate *= scale;
            auto options = build_options(GEOIDX_METRIC_EXACT, 2);
            options.engine = engine;
            const auto index = shared_index(mesh, options);
            const uint32_t count = mesh.vertex_count();
            const auto answers = msad(index.get(), 0, count);
            uint64_t wrong = 0;
            for (uint32_t b = 1; b < count; ++b) {
                const double exact = unit.straight(0, b);
                for (double answer : {double{answers[b]}, double{sssd(index.get(), 0, b)}})
                    wrong += !(answer / scale >= exact * (1 - shortened) && answer / scale <= exact * 1.2);
            }
            CHECK(wrong == 0);
            const Bytes bytes = save(index.get());
            CHECK(save(open(bytes).get()) == bytes);
        }
}

// No float holds these positions or distances: the mesh has to be refused, or the file could not be opened.
TEST_CASE("meshes beyond the range of float are refused or can be saved and opened") {
    for (double scale : {1e38, 1e39, 1e300}) {
        CAPTURE(scale);
        TestMesh mesh = grid(12, 11);
        for (double& coordinate : mesh.positions) coordinate *= scale;
        const geoidx_mesh view = mesh.view();
        const auto options = build_options();
        geoidx* made = nullptr;
        const geoidx_status status = geoidx_build(&view, &options, &made);
        const IndexHandle index(made);
        if (status != GEOIDX_OK) {
            CHECK((status == GEOIDX_ERROR_BAD_MESH || status == GEOIDX_ERROR_LIMIT));
            continue;
        }
        CHECK(open_status(save(index.get())) == GEOIDX_OK);
        for (float distance : msad(index.get(), 0, mesh.vertex_count())) CHECK(std::isfinite(distance));
    }
}
