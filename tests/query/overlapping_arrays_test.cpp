// Answers that are written over the ids they are asked for: nothing outside of the arrays is touched, and the
// query answers as before afterwards.
#include <algorithm>
#include <bit>
#include <cmath>

#include "tests/capi/refusals.h"
#include "tests/query/query_cases.h"

using namespace geodesic::test;

namespace {

using Ids = std::vector<uint32_t>;

constexpr uint32_t MANY_SOURCES = 20; // more than what the overlay engine sweeps together

// Room for distances, of which the first words are ids, and sentinels around it.
class SharedArray {
public:
    SharedArray(size_t room, const Ids& ids) : words_(room + 2 * AROUND, SENTINEL) {
        std::ranges::copy(ids, words_.begin() + AROUND);
    }
    ~SharedArray() {
        const auto is_kept = [](uint32_t word) { return word == SENTINEL; };
        CHECK(std::all_of(words_.begin(), words_.begin() + AROUND, is_kept));
        CHECK(std::all_of(words_.end() - AROUND, words_.end(), is_kept));
    }
    SharedArray(const SharedArray&) = delete;
    SharedArray& operator=(const SharedArray&) = delete;

    uint32_t* ids() { return words_.data() + AROUND; }
    float* distances() { return reinterpret_cast<float*>(ids()); }

private:
    static constexpr uint32_t SENTINEL = 0xdeadbeefu;
    static constexpr ptrdiff_t AROUND = 64;
    Ids words_;
};

void check_status(geoidx_status status) {
    CHECK((status == GEOIDX_OK || status == GEOIDX_ERROR_INVALID_ARGUMENT));
}

void ask_with_overlaps(const geoidx* index, geoidx_query* query, const Ids& ids, uint32_t count) {
    const auto sources = static_cast<uint32_t>(ids.size());
    uint32_t found = 0;
    {
        SharedArray all(count, ids);
        require_success(geoidx_msad(index, all.ids(), sources, all.distances(), count));
        const std::vector<float> right = msad(index, ids, count);
        CHECK(std::equal(right.begin(), right.end(), all.distances()));
    }
    {
        SharedArray all(count, ids);
        require_success(geoidx_query_msad_within(query, all.ids(), sources, 3, all.distances(), count));
    }
    {
        const uint64_t room = uint64_t{sources} * count;
        SharedArray all(room, ids);
        require_success(geoidx_ssad_batch(index, all.ids(), sources, all.distances(), room));
        std::vector<float> right(room);
        require_success(geoidx_ssad_batch(index, ids.data(), sources, right.data(), room));
        CHECK(std::equal(right.begin(), right.end(), all.distances()));
    }
    {
        SharedArray all(count, ids);
        check_status(geoidx_sssd_batch(index, all.ids(), sources / 2, all.distances()));
    }
    for (const uint32_t columns : {sources, 1u}) { // of fields, and of pairs
        SharedArray all(uint64_t{sources} * columns, ids);
        check_status(geoidx_matrix(index, all.ids(), sources, all.ids(), columns, all.distances(),
                                   uint64_t{sources} * columns));
    }
    {
        SharedArray all(count, ids), distances(count, {});
        check_status(
            geoidx_query_nearest_sources(query, all.ids(), sources, all.ids(), distances.distances(), count));
    }
    {
        SharedArray all(count, ids), nearest(count, {});
        check_status(
            geoidx_query_nearest_sources(query, all.ids(), sources, nearest.ids(), all.distances(), count));
    }
    {
        SharedArray all(count, ids), distances(count, {});
        check_status(geoidx_query_within(query, all.ids(), sources, 5, all.ids(), distances.distances(),
                                         count, &found));
        check_status(
            geoidx_query_within(query, ids.data(), sources, 5, all.ids(), all.distances(), count, &found));
    }
    {
        SharedArray all(count, ids), distances(count, {});
        check_status(geoidx_query_nearest_targets(query, ids[0], all.ids(), sources, all.ids(),
                                                  distances.distances(), sources, &found));
    }
    {
        SharedArray all(count, ids), distances(count, {});
        check_status(geoidx_query_farthest_points(query, all.ids(), sources, count, all.ids(),
                                                  distances.distances(), &found));
    }
    {
        SharedArray all(sources, ids);
        require_success(geoidx_query_prepare(query, ids[0]));
        check_status(geoidx_query_prepared(query, all.ids(), sources, all.distances()));
    }
}

void check_overlaps(const TestMesh& mesh, uint32_t engine, uint32_t first) {
    auto options = build_options(GEOIDX_METRIC_EXACT, 2);
    options.engine = engine;
    const auto index = shared_index(mesh, options);
    const QueryHandle query = query_of(index.get());
    const uint32_t count = mesh.vertex_count();
    Ids ids;
    for (uint32_t i = 0; i < MANY_SOURCES; ++i) ids.push_back((first + i * 7) % count);
    ask_with_overlaps(index.get(), query.get(), ids, count);

    Ids nearest(count);
    std::vector<float> distances(count);
    require_success(geoidx_query_nearest_sources(query.get(), ids.data(), MANY_SOURCES, nearest.data(),
                                                 distances.data(), count));
    CHECK(distances == msad(index.get(), ids, count));
    Ids positions(count);
    uint32_t found = 0;
    Ids all_ids(count);
    for (uint32_t v = 0; v < count; ++v) all_ids[v] = v;
    require_success(geoidx_query_nearest_targets(query.get(), ids[1], all_ids.data(), count, positions.data(),
                                                 distances.data(), count, &found));
    CHECK(positions[0] == ids[1]);
}

}

TEST_CASE("overlapping arrays: nothing outside of them is touched") {
    for (const uint32_t engine : {GEOIDX_ENGINE_GRAPH, GEOIDX_ENGINE_OVERLAY}) {
        CAPTURE(engine);
        check_overlaps(hills(18, 18), engine, 3);
        check_overlaps(components_and_unused(), engine, 0); // from a vertex that no triangle uses
    }
}
