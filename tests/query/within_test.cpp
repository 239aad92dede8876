// The vertices within a radius and the nearest targets, against whole fields.
#include <algorithm>
#include <cmath>

#include "tests/capi/counting_allocator.h"
#include "tests/capi/refusals.h"
#include "tests/query/query_cases.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

namespace {

using Ids = std::vector<uint32_t>;
using Ranked = std::vector<std::pair<float, uint32_t>>; // in ascending order

uint32_t count_of(const Ids& ids) { return static_cast<uint32_t>(ids.size()); }

Ranked within(geoidx_query* query, const Ids& sources, float radius) {
    uint32_t count = 0;
    require_success(
        geoidx_query_within(query, sources.data(), count_of(sources), radius, nullptr, nullptr, 0, &count));
    Ids vertices(count, 7);
    std::vector<float> distances(count, -1);
    uint32_t again = 0;
    require_success(geoidx_query_within(query, sources.data(), count_of(sources), radius, vertices.data(),
                                        distances.data(), count, &again));
    REQUIRE(again == count);
    Ranked ranked;
    for (uint32_t i = 0; i < count; ++i) ranked.push_back({distances[i], vertices[i]});
    return ranked;
}

// By the least of the fields of single sources.
Ranked expected_within(const geoidx* index, const Ids& sources, float radius) {
    const auto count = static_cast<uint32_t>(info_of(index).vertex_count);
    std::vector<float> least(count, INFINITE);
    for (const uint32_t source : sources) {
        const auto field = msad(index, source, count);
        for (uint32_t v = 0; v < count; ++v) least[v] = std::min(least[v], field[v]);
    }
    Ranked ranked;
    for (uint32_t v = 0; v < count; ++v)
        if (least[v] <= radius && least[v] < INFINITE) ranked.push_back({least[v], v});
    std::ranges::sort(ranked);
    return ranked;
}

Ranked nearest_targets(geoidx_query* query, uint32_t source, const Ids& targets, uint32_t wanted) {
    Ids positions(wanted, 7);
    std::vector<float> distances(wanted, -1);
    uint32_t count = wanted + 1;
    require_success(geoidx_query_nearest_targets(query, source, targets.data(), count_of(targets),
                                                 positions.data(), distances.data(), wanted, &count));
    REQUIRE(count <= wanted);
    Ranked ranked;
    for (uint32_t i = 0; i < count; ++i) ranked.push_back({distances[i], positions[i]});
    return ranked;
}

Ranked ranked_by(const Ids& targets, const auto& distance_of) {
    Ranked ranked;
    for (uint32_t i = 0; i < targets.size(); ++i)
        if (const float d = distance_of(targets[i]); d < INFINITE) ranked.push_back({d, i});
    std::ranges::sort(ranked);
    return ranked;
}

// The answer must be that of a field, or of pairs, bit for bit.
void check_targets(const geoidx* index, geoidx_query* query, uint32_t source, const Ids& targets,
                   uint32_t wanted) {
    CAPTURE(source);
    CAPTURE(targets.size());
    CAPTURE(wanted);
    const auto field = msad(index, source, static_cast<uint32_t>(info_of(index).vertex_count));
    Ranked by_field = ranked_by(targets, [&](uint32_t target) { return field[target]; });
    Ranked by_pairs = ranked_by(targets, [&](uint32_t target) { return sssd(index, source, target); });
    by_field.resize(std::min<size_t>(by_field.size(), wanted));
    by_pairs.resize(std::min<size_t>(by_pairs.size(), wanted));
    const Ranked found = nearest_targets(query, source, targets, wanted);
    CHECK((found == by_field || found == by_pairs));
}

template <class Check>
void for_each_index(const Check& check) {
    for (const QueryCase& test : exact_cases({1, 3})) {
        CAPTURE(test.name);
        check(index_of(test), test.mesh.vertex_count());
    }
}

// Of one query, in turn: what one sweep leaves must not show in the next one.
void check_within(const geoidx* index, uint32_t count) {
    const QueryHandle query = query_of(index);
    for (const Ids& sources : {Ids{0}, Ids{count / 2}, Ids{count - 1, 0, count / 3}, Ids{1, 1}}) {
        auto field = expected_within(index, sources, INFINITE);
        for (const float radius : {0.0f, field[field.size() / 10].first, field[field.size() / 2].first,
                                   field.back().first, INFINITE, field[field.size() / 4].first}) {
            CAPTURE(sources);
            CAPTURE(radius);
            CHECK(within(query.get(), sources, radius) == expected_within(index, sources, radius));
        }
    }
}

}

TEST_CASE("within: the vertices of fields, in their order") { for_each_index(check_within); }

TEST_CASE("within: default options, and a bumpy mesh of some size") {
    const QueryCase test = case_of_some_size(default_options());
    check_within(index_of(test), test.mesh.vertex_count());
}

// Memory is that of the vertices that are found, however many sources find each.
TEST_CASE("within: many sources take little more memory than one") {
    const TestMesh mesh = hills(smaller(40, 24), 40);
    const auto scratch = [&](uint32_t source_count) {
        CountingAllocator memory;
        auto options = build_options(GEOIDX_METRIC_EXACT, 2);
        options.engine = GEOIDX_ENGINE_OVERLAY;
        options.allocator = memory.get();
        const auto index = build(mesh, options);
        const uint64_t before = memory.bytes();
        const QueryHandle query = query_of(index.get());
        Ids sources;
        for (uint32_t i = 0; i < source_count; ++i) sources.push_back(i);
        CHECK(within(query.get(), sources, INFINITE).size() == mesh.vertex_count());
        return memory.bytes() - before;
    };
    CHECK(scratch(smaller(400, 100)) < scratch(1) + 100 * uint64_t{mesh.vertex_count()});
}

// Paths cross long segments far from their ends: a vertex may be within a radius that no vertex of the border
// around it is.
TEST_CASE("within: on long triangles, at every distance of a field" * doctest::skip(SANITIZED)) {
    for (const float stretch : {4.0f, 8.0f}) {
        TestMesh mesh = grid(40, 30, 0.45);
        for (size_t k = 0; k < mesh.positions.size(); k += 3) mesh.positions[k] *= stretch;
        const auto index = shared_index(mesh, build_options(GEOIDX_METRIC_EXACT, 2));
        const QueryHandle query = query_of(index.get());
        for (uint32_t source = 5; source < mesh.vertex_count(); source += 97) {
            const Ranked field = expected_within(index.get(), {source}, INFINITE);
            for (size_t i = 1; i < field.size(); i += 7) {
                CAPTURE(source);
                CAPTURE(field[i].first);
                CHECK(within(query.get(), {source}, field[i].first) ==
                      Ranked(field.begin(),
                             std::ranges::upper_bound(field, std::pair{field[i].first, UINT32_MAX})));
            }
        }
    }
}

TEST_CASE("within: the nearest ones where there is room for some") {
    const TestMesh mesh = grid(9, 8, 0.2);
    const auto index = shared_index(mesh, build_options(GEOIDX_METRIC_EXACT, 1));
    const QueryHandle query = query_of(index.get());
    const Ranked all = within(query.get(), {5}, 3);
    REQUIRE(all.size() > 4);
    Ids vertices(4, 7);
    std::vector<float> distances(4, -1);
    uint32_t count = 0;
    const uint32_t source = 5;
    require_success(
        geoidx_query_within(query.get(), &source, 1, 3, vertices.data(), distances.data(), 3, &count));
    CHECK(count == all.size());
    for (size_t i = 0; i < 3; ++i) CHECK(all[i] == std::pair{distances[i], vertices[i]});
    CHECK(vertices[3] == 7);
    CHECK(distances[3] == -1);
    require_success(geoidx_query_within(query.get(), &source, 1, 3, vertices.data(), nullptr, 4, &count));
    CHECK(vertices[3] == all[3].second);
}

TEST_CASE("within: vertices that no triangle uses, and those that were welded") {
    TestMesh mesh = grid(6, 5, 0);
    const uint32_t used = mesh.vertex_count();
    // The last triangle once more, over vertices of its own at the same places; and two vertices of none.
    for (size_t k = mesh.triangles.size() - 3; k < mesh.triangles.size(); ++k)
        for (size_t axis = 0; axis < 3; ++axis)
            mesh.positions.push_back(mesh.positions[3 * mesh.triangles[k] + axis]);
    mesh.triangles.insert(mesh.triangles.end(), {used, used + 1, used + 2});
    mesh.positions.insert(mesh.positions.end(), {9, 9, 9, 8, 8, 8});
    auto options = build_options(GEOIDX_METRIC_EXACT, 1);
    options.weld_tolerance = 1e-6;
    const auto index = shared_index(mesh, options);
    const QueryHandle query = query_of(index.get());
    CHECK(within(query.get(), {used + 3}, INFINITE) == Ranked{{0.0f, used + 3}});
    CHECK(within(query.get(), {used + 4, used + 3, used + 4}, 1) ==
          Ranked{{0.0f, used + 3}, {0.0f, used + 4}});
    CHECK(within(query.get(), {0}, INFINITE).size() == used + 3);
    const Ranked at_place = within(query.get(), {used}, 0);
    CHECK(at_place.size() == 2);
    CHECK(at_place == expected_within(index.get(), {used}, 0));
    check_within(index.get(), used);
    check_targets(index.get(), query.get(), used, {used + 3, 3, used + 1, used, 3}, 4);
    check_targets(index.get(), query.get(), used + 3, {used + 3, 3, used + 3}, 3);
}

TEST_CASE("nearest targets: those of fields or of pairs, in their order") {
    for_each_index([](const geoidx* index, uint32_t count) {
        const QueryHandle query = query_of(index);
        for (const uint32_t source : {0u, count / 2, count - 1})
            for (const uint32_t targets : {1u, 5u, count})
                for (const uint32_t wanted : {1u, 3u, count + 2}) {
                    Ids ids;
                    for (uint32_t i = 0; i < targets; ++i) ids.push_back((i * 7919 + 3) % count);
                    check_targets(index, query.get(), source, ids, wanted);
                }
    });
}

TEST_CASE("nearest targets: few and many on a mesh of some size") {
    const QueryCase test = case_of_some_size(build_options(GEOIDX_METRIC_EXACT, 2));
    const geoidx* index = index_of(test);
    const QueryHandle query = query_of(index);
    for (const uint32_t targets : {1u, 3u, 7u, 40u, 1000u})
        for (const uint32_t wanted : {1u, 4u, 100u}) {
            Ids ids;
            for (uint32_t i = 0; i < targets; ++i) ids.push_back((i * 7919 + 3) % test.mesh.vertex_count());
            check_targets(index, query.get(), 1234, ids, wanted);
            check_targets(index, query.get(), 17, ids, wanted);
        }
}

TEST_CASE("within and nearest targets: what is wrong is refused, and the count is 0") {
    const TestMesh mesh = grid(5, 4, 0);
    const auto index = shared_index(mesh, build_options(GEOIDX_METRIC_EXACT, 1));
    const QueryHandle query = query_of(index.get());
    const uint32_t ids[] = {0, mesh.vertex_count()};
    uint32_t found[2] = {7, 7}, count = 9;
    float distances[2];
    const auto refused = [&](geoidx_status status, const char* what) {
        check_refused(status, GEOIDX_ERROR_INVALID_ARGUMENT, what);
        CHECK(count == 0);
        CHECK(found[0] == 7);
        count = 9;
    };
    geoidx_query* const q = query.get();
    refused(geoidx_query_within(nullptr, ids, 1, 1, found, distances, 2, &count), "query");
    refused(geoidx_query_within(q, nullptr, 1, 1, found, distances, 2, &count), "sources");
    refused(geoidx_query_within(q, ids, 0, 1, found, distances, 2, &count), "source");
    refused(geoidx_query_within(q, ids, 2, 1, found, distances, 2, &count), "out of range");
    refused(geoidx_query_within(q, ids, 1, -1, found, distances, 2, &count), "radius");
    refused(geoidx_query_within(q, ids, 1, std::nanf(""), found, distances, 2, &count), "radius");
    refused(geoidx_query_within(q, ids, 1, 1, nullptr, distances, 2, &count), "vertices");
    refused(geoidx_query_nearest_targets(nullptr, 0, ids, 1, found, distances, 2, &count), "query");
    refused(geoidx_query_nearest_targets(q, ids[1], ids, 1, found, distances, 2, &count), "out of range");
    refused(geoidx_query_nearest_targets(q, 0, ids, 2, found, distances, 2, &count), "out of range");
    refused(geoidx_query_nearest_targets(q, 0, nullptr, 1, found, distances, 2, &count), "targets");
    refused(geoidx_query_nearest_targets(q, 0, ids, 1, nullptr, distances, 2, &count), "positions");
    count = 0;
    refused(geoidx_query_within(q, ids, 1, 1, found, distances, 2, nullptr), "count");
    count = 0;
    refused(geoidx_query_nearest_targets(q, 0, ids, 1, found, distances, 2, nullptr), "count");
    require_success(geoidx_query_nearest_targets(q, 0, nullptr, 0, nullptr, nullptr, 0, &count));
    CHECK(count == 0);
    require_success(geoidx_query_nearest_targets(q, 0, ids, 1, nullptr, nullptr, 0, &count));
    CHECK(count == 0);
}
