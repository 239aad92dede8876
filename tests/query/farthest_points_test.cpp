// Farthest points against their definition, by fields of single sources.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "tests/capi/refusals.h"
#include "tests/query/query_cases.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

namespace {

struct Sampling {
    std::vector<uint32_t> points;
    std::vector<float> distances;
};

Sampling farthest_points(const geoidx* index, const std::vector<uint32_t>& sources, uint32_t count) {
    Sampling sampling{std::vector<uint32_t>(count), std::vector<float>(count)};
    const QueryHandle query = query_of(index);
    uint32_t found = count + 1;
    require_success(geoidx_query_farthest_points(query.get(), sources.data(),
                                                 static_cast<uint32_t>(sources.size()), count,
                                                 sampling.points.data(), sampling.distances.data(), &found));
    REQUIRE(found <= count);
    sampling.points.resize(found);
    sampling.distances.resize(found);
    return sampling;
}

// The distance of every vertex from the nearest of those that were added.
class Nearest {
public:
    Nearest(const geoidx* index, const TestMesh& mesh)
        : index_(index), distances_(mesh.vertex_count(), std::numeric_limits<float>::infinity()),
          is_used_(mesh.vertex_count(), false) {
        for (const uint32_t vertex : mesh.triangles) is_used_[vertex] = true;
    }
    void add(uint32_t source) {
        const auto field = msad(index_, source, static_cast<uint32_t>(distances_.size()));
        for (size_t v = 0; v < field.size(); ++v) distances_[v] = std::min(distances_[v], field[v]);
    }
    float of(uint32_t vertex) const { return distances_[vertex]; }
    bool is_used(uint32_t vertex) const { return is_used_[vertex]; }
    float largest() const {
        float largest = 0;
        for (size_t v = 0; v < distances_.size(); ++v)
            if (is_used_[v]) largest = std::max(largest, distances_[v]);
        return largest;
    }

private:
    const geoidx* index_;
    std::vector<float> distances_;
    std::vector<bool> is_used_;
};

// Of several sources a field may be a little different from the least of the single ones.
bool is_about(float a, float b) { return a == b || std::abs(a - b) <= 0.02f * b; }

}

TEST_CASE("farthest points: each is as far from those before it as any vertex is" *
          doctest::skip(SANITIZED)) {
    for (const QueryCase& test : exact_cases({2})) {
        CAPTURE(test.name);
        const geoidx* index = index_of(test);
        const std::vector<uint32_t> sources{test.mesh.vertex_count() / 2, 0};
        Nearest nearest(index, test.mesh);
        for (const uint32_t source : sources) nearest.add(source);
        const Sampling sampling = farthest_points(index, sources, 12);
        for (size_t i = 0; i < sampling.points.size(); ++i) {
            CAPTURE(i);
            CHECK(nearest.is_used(sampling.points[i]));
            CHECK(is_about(sampling.distances[i], nearest.largest()));
            CHECK(is_about(nearest.of(sampling.points[i]), sampling.distances[i]));
            nearest.add(sampling.points[i]);
        }
        if (sampling.points.size() < 12) CHECK(nearest.largest() == 0);
    }
}

TEST_CASE("farthest points: from one source they are those of its fields, bit for bit") {
    const TestMesh mesh = grid(40, 30, 0.3);
    const auto index = shared_index(mesh, build_options(GEOIDX_METRIC_EXACT, 2));
    Nearest nearest(index.get(), mesh);
    nearest.add(17);
    const Sampling sampling = farthest_points(index.get(), {17}, 100);
    REQUIRE(sampling.points.size() == 100);
    for (size_t i = 0; i < 100; ++i) {
        CHECK(sampling.distances[i] == nearest.largest());
        CHECK(nearest.of(sampling.points[i]) == nearest.largest());
        nearest.add(sampling.points[i]);
    }
}

TEST_CASE("farthest points: all vertices but the source, and none twice") {
    TestMesh mesh = grid(5, 4, 0);
    const uint32_t used = mesh.vertex_count();
    mesh.positions.insert(mesh.positions.end(), {9, 9, 9}); // no triangle uses it
    const auto index = shared_index(mesh, build_options(GEOIDX_METRIC_EXACT, 1));
    Sampling sampling = farthest_points(index.get(), {3}, used + 5);
    CHECK(sampling.points.size() == used - 1);
    CHECK(std::ranges::is_sorted(sampling.distances, std::greater{}));
    std::ranges::sort(sampling.points);
    CHECK(std::ranges::adjacent_find(sampling.points) == sampling.points.end());
    CHECK(sampling.points.back() < used);
    CHECK(std::ranges::find(sampling.points, 3u) == sampling.points.end());
    // Nothing is reached from the vertex that no triangle uses.
    sampling = farthest_points(index.get(), {used}, 1);
    REQUIRE(sampling.points.size() == 1);
    CHECK(std::isinf(sampling.distances[0]));
}

TEST_CASE("farthest points: one of those that edges without cost join") {
    constexpr uint32_t COLUMNS = 5, ROWS = 4;
    const TestMesh mesh = grid(COLUMNS, ROWS, 0);
    std::vector<uint32_t> along_rows;
    for (uint32_t y = 0; y < ROWS; ++y)
        for (uint32_t x = 0; x + 1 < COLUMNS; ++x)
            along_rows.insert(along_rows.end(), {y * COLUMNS + x, y * COLUMNS + x + 1});
    const std::vector<double> nothing(along_rows.size() / 2, 0);
    for (const uint32_t engine : {GEOIDX_ENGINE_GRAPH, GEOIDX_ENGINE_OVERLAY}) {
        CAPTURE(engine);
        auto options = build_options(GEOIDX_METRIC_EDGES, 1);
        options.engine = engine;
        options.edge_cost_vertices = along_rows.data();
        options.edge_costs = nothing.data();
        options.edge_cost_count = static_cast<uint32_t>(nothing.size());
        const Sampling sampling = farthest_points(build(mesh, options).get(), {3}, mesh.vertex_count());
        std::vector<uint32_t> rows;
        for (const uint32_t point : sampling.points) rows.push_back(point / COLUMNS);
        std::ranges::sort(rows);
        CHECK(rows == std::vector<uint32_t>{1, 2, 3});
    }
}

TEST_CASE("farthest points: what is wrong is refused") {
    const TestMesh mesh = grid(5, 4, 0);
    const auto index = shared_index(mesh, build_options(GEOIDX_METRIC_EXACT, 1));
    const QueryHandle query = query_of(index.get());
    const uint32_t ids[] = {0, mesh.vertex_count()};
    uint32_t points[2], count = 7;
    float distances[2];
    const auto refused = [](geoidx_status status, const char* what) {
        check_refused(status, GEOIDX_ERROR_INVALID_ARGUMENT, what);
    };
    const auto ask = [&](geoidx_query* of, const uint32_t* sources, uint32_t source_count, uint32_t* to,
                         uint32_t* number) {
        return geoidx_query_farthest_points(of, sources, source_count, 2, to, distances, number);
    };
    refused(ask(nullptr, ids, 1, points, &count), "query");
    CHECK(count == 0);
    refused(ask(query.get(), nullptr, 1, points, &count), "sources");
    refused(ask(query.get(), ids, 0, points, &count), "source");
    refused(ask(query.get(), ids, 2, points, &count), "out of range");
    refused(ask(query.get(), ids, 1, nullptr, &count), "points");
    refused(ask(query.get(), ids, 1, points, nullptr), "count");
    require_success(geoidx_query_farthest_points(query.get(), ids, 1, 2, points, nullptr, &count));
    CHECK(count == 2);
    require_success(geoidx_query_farthest_points(query.get(), ids, 1, 0, nullptr, nullptr, &count));
    CHECK(count == 0);
}
