// Matrices against single questions. Which of them a matrix asks depends on its size, so that there are
// matrices of every kind: few and many sources, few and many targets.
#include <algorithm>
#include <cmath>

#include "tests/capi/refusals.h"
#include "tests/query/query_cases.h"

using namespace geodesic::test;

namespace {

using Ids = std::vector<uint32_t>;

uint32_t size_of(const Ids& ids) { return static_cast<uint32_t>(ids.size()); }

// Ids all over the mesh, in no order; repeated if there are not so many.
Ids spread_ids(uint32_t vertex_count, uint32_t count, uint32_t from = 0) {
    Ids ids;
    for (uint32_t i = 0; i < count; ++i) ids.push_back((from + i * 7919u) % vertex_count);
    return ids;
}

std::vector<float> matrix(const geoidx* index, const Ids& sources, const Ids& targets) {
    std::vector<float> of_index(sources.size() * targets.size(), -1), of_query = of_index;
    require_success(geoidx_matrix(index, sources.data(), size_of(sources), targets.data(), size_of(targets),
                                  of_index.data(), of_index.size()));
    require_success(geoidx_query_matrix(query_of(index).get(), sources.data(), size_of(sources),
                                        targets.data(), size_of(targets), of_query.data(), of_query.size()));
    CHECK(of_index == of_query);
    return of_index;
}

// Every entry must be what one of the single questions gives, bit for bit.
void check_matrix(const geoidx* index, const Ids& sources, const Ids& targets) {
    CAPTURE(sources.size());
    CAPTURE(targets.size());
    const auto count = static_cast<uint32_t>(info_of(index).vertex_count);
    const std::vector<float> entries = matrix(index, sources, targets);
    std::vector<std::vector<float>> to;
    for (const uint32_t target : targets) to.push_back(msad(index, target, count));
    for (size_t i = 0; i < sources.size(); ++i) {
        const auto from = msad(index, sources[i], count);
        for (size_t j = 0; j < targets.size(); ++j) {
            const float entry = entries[i * targets.size() + j];
            CAPTURE(sources[i]);
            CAPTURE(targets[j]);
            CHECK((entry == from[targets[j]] || entry == to[j][sources[i]] ||
                   entry == sssd(index, sources[i], targets[j])));
        }
    }
}

}

TEST_CASE("matrix: each entry is that of a single question") {
    for (const QueryCase& test : exact_cases({2})) {
        CAPTURE(test.name);
        const geoidx* index = index_of(test);
        const uint32_t count = test.mesh.vertex_count();
        for (const auto& [sources, targets] :
             {std::pair{1u, 1u}, {1u, 30u}, {30u, 1u}, {3u, 20u}, {11u, 35u}, {35u, 18u}})
            check_matrix(index, spread_ids(count, sources), spread_ids(count, targets, 3));
    }
}

TEST_CASE("matrix: pairs where few targets are asked for on a mesh of some size") {
    const QueryCase test = case_of_some_size(build_options(GEOIDX_METRIC_EXACT, 2));
    const geoidx* index = index_of(test);
    const uint32_t count = test.mesh.vertex_count();
    for (const uint32_t targets : {1u, 2u, 6u, 8u, 40u})
        for (const uint32_t sources : {1u, 2u, 9u, 40u})
            check_matrix(index, spread_ids(count, sources), spread_ids(count, targets, 11));
    const Ids few = spread_ids(count, 6);
    check_matrix(index, few, few);
}

TEST_CASE("matrix: vertices that no triangle uses, and those that were welded") {
    TestMesh mesh = grid(6, 5, 0);
    const uint32_t used = mesh.vertex_count();
    mesh.positions.insert(mesh.positions.end(), {9, 9, 9, 8, 8, 8});
    const auto index = shared_index(mesh, build_options(GEOIDX_METRIC_EXACT, 1));
    Ids all = spread_ids(used + 2, used + 2);
    all.push_back(used);
    for (const Ids& sources : {Ids{used}, Ids{used, 3}, all}) {
        const std::vector<float> entries = matrix(index.get(), sources, all);
        for (size_t i = 0; i < sources.size(); ++i)
            for (size_t j = 0; j < all.size(); ++j) {
                const float entry = entries[i * all.size() + j];
                if (sources[i] == all[j])
                    CHECK(entry == 0);
                else
                    CHECK(std::isinf(entry) == (sources[i] >= used || all[j] >= used));
            }
    }
}

TEST_CASE("matrix: nothing is asked for") {
    const TestMesh mesh = grid(5, 4, 0);
    const auto index = shared_index(mesh, build_options(GEOIDX_METRIC_EXACT, 1));
    const uint32_t id = 0;
    require_success(geoidx_matrix(index.get(), nullptr, 0, nullptr, 0, nullptr, 0));
    require_success(geoidx_matrix(index.get(), &id, 1, nullptr, 0, nullptr, 0));
    require_success(geoidx_matrix(index.get(), nullptr, 0, &id, 1, nullptr, 0));
}

TEST_CASE("matrix: what is wrong is refused, and nothing is written") {
    const TestMesh mesh = grid(5, 4, 0);
    const auto index = shared_index(mesh, build_options(GEOIDX_METRIC_EXACT, 1));
    const QueryHandle query = query_of(index.get());
    const uint32_t ids[] = {0, 1, mesh.vertex_count()};
    float entries[4] = {-1, -1, -1, -1};
    const auto refused = [&](geoidx_status status, const char* what) {
        check_refused(status, GEOIDX_ERROR_INVALID_ARGUMENT, what);
        CHECK(std::ranges::count(entries, -1.0f) == 4);
    };
    refused(geoidx_matrix(nullptr, ids, 2, ids, 2, entries, 4), "index");
    refused(geoidx_query_matrix(nullptr, ids, 2, ids, 2, entries, 4), "query");
    refused(geoidx_query_matrix(query.get(), nullptr, 2, ids, 2, entries, 4), "sources");
    refused(geoidx_query_matrix(query.get(), ids, 2, nullptr, 2, entries, 4), "targets");
    refused(geoidx_query_matrix(query.get(), ids, 2, ids, 2, nullptr, 4), "distances");
    refused(geoidx_query_matrix(query.get(), ids, 2, ids, 2, entries, 3), "distance_count");
    refused(geoidx_query_matrix(query.get(), ids, 1, ids + 1, 2, entries, 2), "out of range");
    refused(geoidx_query_matrix(query.get(), ids + 1, 2, ids, 1, entries, 2), "out of range");
}
