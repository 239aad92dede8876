// Several questions at once give what they give one by one.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/capi/refusals.h"
#include "tests/query/query_cases.h"

using namespace geodesic::test;

namespace {

std::vector<QueryCase> cases_of_both_engines() {
    std::vector<QueryCase> cases;
    for (const auto& [name, mesh] : mesh_zoo())
        for (uint32_t engine : {GEOIDX_ENGINE_GRAPH, GEOIDX_ENGINE_OVERLAY}) {
            auto options = build_options(GEOIDX_METRIC_EXACT, 2);
            options.engine = engine;
            options.exact_vertices = 10;
            cases.push_back({name + ", batch, engine " + std::to_string(engine), mesh, options});
        }
    return cases;
}

std::vector<float> prepared(geoidx_query* query, uint32_t source, const std::vector<uint32_t>& targets) {
    std::vector<float> distances(targets.size());
    require_success(geoidx_query_prepare(query, source));
    require_success(geoidx_query_prepared(query, targets.data(), targets.size(), distances.data()));
    return distances;
}

}

TEST_CASE("batch: sources one by one, bit for bit") {
    for (const QueryCase& test : cases_of_both_engines()) {
        CAPTURE(test.name);
        const geoidx* index = index_of(test);
        const uint32_t count = test.mesh.vertex_count();
        std::vector<uint32_t> sources; // more than are taken at once, some twice
        for (uint32_t i = 0; i < 37; ++i) sources.push_back(i * 13 % count);
        std::vector<float> batch(sources.size() * count), of_query(batch.size());
        require_success(geoidx_ssad_batch(index, sources.data(), 37, batch.data(), batch.size()));
        const QueryHandle query = query_of(index);
        require_success(
            geoidx_query_ssad_batch(query.get(), sources.data(), 37, of_query.data(), of_query.size()));
        CHECK(batch == of_query);
        uint64_t wrong = 0;
        for (size_t i = 0; i < sources.size(); ++i) {
            const auto alone = msad(index, sources[i], count);
            wrong += std::memcmp(alone.data(), batch.data() + i * count, count * sizeof(float)) != 0;
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("batch: within a radius distances are the same, beyond it there are none") {
    for (const QueryCase& test : cases_of_both_engines()) {
        CAPTURE(test.name);
        const geoidx* index = index_of(test);
        const uint32_t count = test.mesh.vertex_count();
        const QueryHandle query = query_of(index);
        const std::vector<uint32_t> sources{count / 3, 0};
        const auto all = msad(index, sources, count);
        float longest = 0;
        for (float d : all)
            if (std::isfinite(d)) longest = std::max(longest, d);
        std::vector<float> within(count);
        for (float radius : {0.0f, longest / 4, longest / 2, longest, INFINITY}) {
            require_success(
                geoidx_query_msad_within(query.get(), sources.data(), 2, radius, within.data(), count));
            uint64_t wrong = 0;
            for (uint32_t v = 0; v < count; ++v) wrong += within[v] != (all[v] <= radius ? all[v] : INFINITY);
            CHECK(wrong == 0);
        }
        for (float radius : {-1.0f, -INFINITY, NAN})
            check_refused(
                geoidx_query_msad_within(query.get(), sources.data(), 2, radius, within.data(), count),
                GEOIDX_ERROR_INVALID_ARGUMENT, "radius");
    }
}

// Vertices close to edges are nearer to what lies across than the ends and the middle of the edge are.
TEST_CASE("batch: within a radius shorter than the edges") {
    TestMesh mesh = grid(12, 12);
    const std::vector<uint32_t> triangles = mesh.triangles;
    mesh.triangles.clear();
    for (size_t t = 0; t < triangles.size(); t += 3) {
        const uint32_t a = triangles[t], b = triangles[t + 1], c = triangles[t + 2];
        const bool is_below = t % 2 == 0; // the diagonal of its cell, which begins at a
        const auto close = [&](size_t axis) {
            const auto at = [&](uint32_t v) { return mesh.positions[3 * v + axis]; };
            return 0.74 * at(a) + 0.01 * at(is_below ? b : c) + 0.25 * at(is_below ? c : b);
        };
        const uint32_t inside = mesh.add_vertex(close(0), close(1), 0);
        mesh.add_triangle(a, b, inside);
        mesh.add_triangle(b, c, inside);
        mesh.add_triangle(c, a, inside);
    }
    auto options = build_options(GEOIDX_METRIC_EXACT, 3);
    options.engine = GEOIDX_ENGINE_OVERLAY;
    const auto index = shared_index(mesh, options);
    const QueryHandle query = query_of(index.get());
    const uint32_t count = mesh.vertex_count();
    std::vector<float> within(count);
    uint64_t wrong = 0;
    for (uint32_t source = 0; source < count; ++source) {
        const auto all = msad(index.get(), source, count);
        for (float radius : {0.02f, 0.1f, 0.2f, 0.4f}) {
            require_success(geoidx_query_msad_within(query.get(), &source, 1, radius, within.data(), count));
            for (uint32_t v = 0; v < count; ++v) wrong += within[v] != (all[v] <= radius ? all[v] : INFINITY);
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("batch: threads change no bit") {
    for (const QueryCase& test : cases_of_both_engines()) {
        CAPTURE(test.name);
        const geoidx* index = index_of(test);
        const uint32_t count = test.mesh.vertex_count();
        const QueryHandle query = query_of(index);
        std::vector<float> field(count);
        for (const std::vector<uint32_t>& sources :
             {std::vector<uint32_t>{count / 2}, {0, count - 1, count / 3, 0}}) {
            const auto alone = msad(index, sources, count);
            for (uint32_t threads : {2u, 7u, 0u, 3u, 1u}) {
                require_success(geoidx_query_set_threads(query.get(), threads));
                require_success(geoidx_query_msad(
                    query.get(), sources.data(), static_cast<uint32_t>(sources.size()), field.data(), count));
                CHECK(field == alone);
            }
        }
    }
}

TEST_CASE("batch: from a prepared source") {
    for (const QueryCase& test : cases_of_both_engines()) {
        CAPTURE(test.name);
        const geoidx* index = index_of(test);
        const uint32_t count = test.mesh.vertex_count();
        const QueryHandle query = query_of(index);
        std::vector<uint32_t> targets;
        for (uint32_t v = 0; v < count; v += 3) targets.push_back(v);
        uint64_t wrong = 0, pairs = 0;
        double difference = 0, from_field = 0;
        for (uint32_t source : {0u, count / 2, count - 1}) {
            const auto distances = prepared(query.get(), source, targets);
            const auto alone = msad(index, source, count);
            for (size_t i = 0; i < targets.size(); ++i) {
                const double pair = double{sssd(index, source, targets[i])}, d = double{distances[i]};
                wrong += std::isfinite(pair) != std::isfinite(d) || (targets[i] == source && d != 0);
                if (!std::isfinite(pair) || pair == 0) continue;
                difference += std::abs(d - pair) / pair;
                from_field += std::abs(d - double{alone[targets[i]]}) / pair;
                ++pairs;
                wrong += std::abs(d - pair) > 0.1 * pair;
            }
            // It is kept, whatever else is asked.
            std::vector<float> field(count);
            const uint32_t other = count / 3;
            require_success(geoidx_query_msad(query.get(), &other, 1, field.data(), count));
            std::vector<float> again(targets.size());
            require_success(geoidx_query_prepared(query.get(), targets.data(), targets.size(), again.data()));
            CHECK(again == distances);
        }
        CHECK(wrong == 0);
        CHECK(difference <= 2e-3 * static_cast<double>(pairs));
        CHECK(from_field <= 1e-3 * static_cast<double>(pairs));
    }
}

TEST_CASE("batch: what is wrong is refused") {
    const TestMesh mesh = grid(5, 4);
    const uint32_t count = mesh.vertex_count();
    for (uint32_t engine : {GEOIDX_ENGINE_GRAPH, GEOIDX_ENGINE_OVERLAY}) {
        auto options = build_options();
        options.engine = engine;
        const auto index = shared_index(mesh, options);
        const QueryHandle query = query_of(index.get());
        const uint32_t ids[] = {0, count};
        std::vector<float> distances(2 * size_t{count});
        const auto refused = [](geoidx_status status, const char* what) {
            check_refused(status, GEOIDX_ERROR_INVALID_ARGUMENT, what);
        };
        refused(geoidx_query_prepared(query.get(), ids, 1, distances.data()), "prepared");
        refused(geoidx_query_prepared(query.get(), nullptr, 0, nullptr), "prepared");
        refused(geoidx_query_prepare(query.get(), count), "out of range");
        refused(geoidx_query_prepared(query.get(), ids, 1, distances.data()), "prepared");
        require_success(geoidx_query_prepare(query.get(), 1));
        refused(geoidx_query_prepared(query.get(), ids, 2, distances.data()), "out of range");
        refused(geoidx_query_prepared(query.get(), nullptr, 1, distances.data()), "targets");
        refused(geoidx_query_prepared(query.get(), ids, 1, nullptr), "distances");
        refused(geoidx_query_prepared(nullptr, ids, 1, distances.data()), "query");
        refused(geoidx_query_prepare(nullptr, 0), "query");
        require_success(geoidx_query_prepared(query.get(), nullptr, 0, nullptr));

        refused(geoidx_ssad_batch(nullptr, ids, 1, distances.data(), count), "index");
        refused(geoidx_ssad_batch(index.get(), nullptr, 1, distances.data(), count), "sources");
        refused(geoidx_ssad_batch(index.get(), ids, 1, nullptr, count), "distances");
        refused(geoidx_ssad_batch(index.get(), ids, 2, distances.data(), count), "distance_count");
        refused(geoidx_ssad_batch(index.get(), ids, 1, distances.data(), 2 * count), "distance_count");
        refused(geoidx_ssad_batch(index.get(), ids, 2, distances.data(), 2 * count), "out of range");
        refused(geoidx_ssad_batch(index.get(), ids, 0, distances.data(), count), "distance_count");
        require_success(geoidx_ssad_batch(index.get(), nullptr, 0, nullptr, 0)); // as matrices and pairs
        require_success(geoidx_query_ssad_batch(query.get(), nullptr, 0, nullptr, 0));
        refused(geoidx_query_ssad_batch(nullptr, ids, 1, distances.data(), count), "query");
        refused(geoidx_query_set_threads(nullptr, 1), "query");
        refused(geoidx_query_set_threads(query.get(), 1025), "threads");
        refused(geoidx_query_msad_within(nullptr, ids, 1, 1, distances.data(), count), "query");
    }
}
