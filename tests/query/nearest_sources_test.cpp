// The nearest source to each vertex, against fields of the single sources.
#include <algorithm>
#include <cmath>

#include "tests/capi/refusals.h"
#include "tests/query/query_cases.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

namespace {

using Ids = std::vector<uint32_t>;

struct Answer {
    Ids nearest;
    std::vector<float> distances;
};

Answer nearest_sources(geoidx_query* query, const Ids& sources, uint32_t count) {
    Answer answer{Ids(count, 7), std::vector<float>(count, -1)};
    require_success(geoidx_query_nearest_sources(query, sources.data(), static_cast<uint32_t>(sources.size()),
                                                 answer.nearest.data(), answer.distances.data(), count));
    return answer;
}

// The source that is said to be the nearest must be, by fields of each source alone: to rounding by the graph
// engine, and otherwise as well as a field of several sources keeps to those of the single ones.
void check_nearest(const geoidx* index, const Ids& sources, double tolerance) {
    const auto count = static_cast<uint32_t>(info_of(index).vertex_count);
    const QueryHandle query = query_of(index);
    const Answer answer = nearest_sources(query.get(), sources, count);
    CHECK(answer.distances == msad(index, sources, count));
    std::vector<std::vector<float>> from;
    for (const uint32_t source : sources) from.push_back(msad(index, source, count));
    for (uint32_t v = 0; v < count; ++v) {
        CAPTURE(v);
        const uint32_t nearest = answer.nearest[v];
        REQUIRE((nearest == GEOIDX_NO_SOURCE) == std::isinf(answer.distances[v]));
        if (nearest == GEOIDX_NO_SOURCE) continue;
        REQUIRE(nearest < sources.size());
        float least = from[0][v];
        for (const auto& field : from) least = std::min(least, field[v]);
        CHECK(from[nearest][v] <= least * (1 + tolerance));
    }
    for (uint32_t threads = 2; threads <= 3; ++threads) {
        require_success(geoidx_query_set_threads(query.get(), threads));
        const Answer again = nearest_sources(query.get(), sources, count);
        CHECK(again.nearest == answer.nearest);
        CHECK(again.distances == answer.distances);
    }
}

}

TEST_CASE("nearest sources: no other source is nearer" * doctest::skip(SANITIZED)) {
    for (const QueryCase& test : exact_cases({1, 2})) {
        CAPTURE(test.name);
        const geoidx* index = index_of(test);
        const uint32_t count = test.mesh.vertex_count();
        const double tolerance = test.options.engine == GEOIDX_ENGINE_GRAPH ? ROUNDING : 0.02;
        check_nearest(index, {count / 2}, 0);
        check_nearest(index, {0, count - 1}, tolerance);
        Ids many;
        for (uint32_t i = 0; i < 9; ++i) many.push_back((i * 31) % count);
        check_nearest(index, many, tolerance);
    }
}

TEST_CASE("nearest sources: default options, and a bumpy mesh of some size" * doctest::skip(SANITIZED)) {
    const QueryCase test = case_of_some_size(default_options());
    Ids sources;
    for (uint32_t i = 0; i < 64; ++i) sources.push_back((i * 7919) % test.mesh.vertex_count());
    check_nearest(index_of(test), sources, 0.02);
}

TEST_CASE("nearest sources: none in a component that has none, whichever vertices they are") {
    TestMesh mesh = grid(4, 4, 0.2);
    const uint32_t half = mesh.vertex_count();
    for (uint32_t v = 0; v < 3 * half; ++v)
        mesh.positions.push_back(mesh.positions[v] + (v % 3 == 0 ? 1000.0f : 0.0f));
    for (size_t k = 0, count = mesh.triangles.size(); k < count; ++k)
        mesh.triangles.push_back(mesh.triangles[k] + half);
    auto options = build_options(GEOIDX_METRIC_EXACT, 1);
    options.patches[0] = 4;
    const auto index = shared_index(mesh, options);
    for (uint32_t a = 0; a < half; ++a)
        for (uint32_t b = a + 1; b < half; b += 3) check_nearest(index.get(), {a, b}, 0.02);
    check_nearest(index.get(), {3, half + 5}, 0.02);
}

TEST_CASE("nearest sources: a cut in the middle of a flat strip") {
    // Straight lines: the source on the own side is nearer by more than any error.
    const TestMesh mesh = grid(41, 5, 0);
    const auto index = shared_index(mesh, build_options(GEOIDX_METRIC_EXACT, 2));
    Ids ends;
    for (uint32_t y = 0; y < 5; ++y) ends.push_back(y * 41);
    for (uint32_t y = 0; y < 5; ++y) ends.push_back(y * 41 + 40);
    const Answer answer = nearest_sources(query_of(index.get()).get(), ends, mesh.vertex_count());
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        const uint32_t x = v % 41, y = v / 41;
        if (x != 20) CHECK(answer.nearest[v] == (x < 20 ? y : 5 + y));
    }
}

TEST_CASE("nearest sources: positions in the caller's order, the first of repeated ones") {
    TestMesh mesh = grid(6, 5, 0);
    const uint32_t used = mesh.vertex_count();
    mesh.positions.insert(mesh.positions.end(), {9, 9, 9, 8, 8, 8}); // no triangle uses them
    for (const uint32_t engine : {GEOIDX_ENGINE_GRAPH, GEOIDX_ENGINE_OVERLAY}) {
        auto options = build_options(GEOIDX_METRIC_EXACT, 1);
        options.engine = engine;
        const auto index = shared_index(mesh, options);
        const QueryHandle query = query_of(index.get());
        const Answer answer = nearest_sources(query.get(), {used - 1, 0, 0, used, used - 1, used}, used + 2);
        CHECK(answer.nearest[used - 1] == 0);
        CHECK(answer.nearest[0] == 1);
        CHECK(answer.nearest[used] == 3);
        CHECK(answer.nearest[used + 1] == GEOIDX_NO_SOURCE);
        CHECK(answer.distances[used] == 0);
        CHECK(std::ranges::count(answer.nearest, 2u) + std::ranges::count(answer.nearest, 4u) +
                  std::ranges::count(answer.nearest, 5u) ==
              0);
        // Only a vertex that nothing uses.
        const Answer alone = nearest_sources(query.get(), {used}, used + 2);
        CHECK(alone.nearest[used] == 0);
        CHECK(std::ranges::count(alone.nearest, GEOIDX_NO_SOURCE) == used + 1);
    }
}

TEST_CASE("nearest sources: distances may be left out, and what is wrong is refused") {
    const TestMesh mesh = grid(5, 4, 0);
    const uint32_t count = mesh.vertex_count();
    const auto index = shared_index(mesh, build_options(GEOIDX_METRIC_EXACT, 1));
    const QueryHandle query = query_of(index.get());
    const Ids ids{0, count};
    Ids nearest(count, 7);
    const auto refused = [&](geoidx_query* of, const uint32_t* sources, uint32_t source_count, uint32_t* out,
                             uint32_t out_count, const char* what) {
        check_refused(geoidx_query_nearest_sources(of, sources, source_count, out, nullptr, out_count),
                      GEOIDX_ERROR_INVALID_ARGUMENT, what);
        CHECK(std::ranges::count(nearest, 7u) == count);
    };
    refused(nullptr, ids.data(), 1, nearest.data(), count, "query");
    refused(query.get(), nullptr, 1, nearest.data(), count, "sources");
    refused(query.get(), ids.data(), 0, nearest.data(), count, "source");
    refused(query.get(), ids.data(), 2, nearest.data(), count, "out of range");
    refused(query.get(), ids.data(), 1, nullptr, count, "nearest");
    refused(query.get(), ids.data(), 1, nearest.data(), count - 1, "vertex_count");
    require_success(geoidx_query_nearest_sources(query.get(), ids.data(), 1, nearest.data(), nullptr, count));
    CHECK(std::ranges::count(nearest, 0u) == count);
}
