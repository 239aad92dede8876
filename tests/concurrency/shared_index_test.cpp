// One index, many threads: every thread gets what one thread alone gets. The thread sanitizer watches.

#include <algorithm>
#include <atomic>
#include <barrier>
#include <thread>

#include "format/bytes.h"
#include "format/container.h"
#include "src/file/sections.h"
#include "tests/capi/calls.h"
#include "tests/capi/counting_allocator.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

constexpr uint32_t THREADS = 8, ROUNDS = 12;

struct Expected {
    std::vector<uint32_t> pairs;
    std::vector<float> of_pairs;
    std::vector<std::vector<float>> of_sources; // [i]: MSAD of pairs[2 i] and pairs[2 i + 1]
    std::vector<std::vector<float>> of_first;   // [i]: of pairs[2 i] alone
    std::vector<uint32_t> farthest;             // from pairs[0]
    std::vector<float> prepared;                // of_pairs, from prepared sources
};

std::vector<uint32_t> farthest_points(geoidx_query* query, uint32_t first) {
    std::vector<uint32_t> points(5, first);
    uint32_t count = 0;
    if (geoidx_query_farthest_points(query, &first, 1, 5, points.data(), nullptr, &count) != GEOIDX_OK)
        points.clear();
    points.resize(std::min<size_t>(points.size(), count));
    return points;
}

Expected single_threaded(const geoidx* index, uint32_t count) {
    Expected expected;
    const QueryHandle query = query_of(index);
    for (uint32_t i = 0; i < ROUNDS; ++i) {
        const uint32_t a = i * 67 % count, b = (i * 151 + 40) % count;
        expected.pairs.insert(expected.pairs.end(), {a, b});
        expected.of_pairs.push_back(sssd(index, a, b));
        expected.of_sources.push_back(msad(index, std::vector<uint32_t>{a, b}, count));
        expected.of_first.push_back(msad(index, a, count));
        expected.prepared.emplace_back();
        require_success(geoidx_query_prepare(query.get(), a));
        require_success(geoidx_query_prepared(query.get(), &b, 1, &expected.prepared.back()));
    }
    expected.farthest = farthest_points(query.get(), expected.pairs[0]);
    return expected;
}

// No doctest macro here: they take locks, which would order what should not be ordered.
uint64_t differences(const geoidx* index, uint32_t thread, uint32_t count, const Expected& expected) {
    uint64_t wrong = 0;
    geoidx_query* query = nullptr;
    wrong += geoidx_query_create(index, &query) != GEOIDX_OK;
    wrong += geoidx_query_set_threads(query, 1 + thread % 3) != GEOIDX_OK;
    std::vector<float> distances(count), batch(ROUNDS);
    for (uint32_t step = 0; step < ROUNDS; ++step) {
        const uint32_t i = (step + thread) % ROUNDS; // each in another order
        const uint32_t* pair = &expected.pairs[2 * i];
        float distance = -1;
        wrong += geoidx_sssd(index, pair[0], pair[1], &distance) != GEOIDX_OK;
        wrong += distance != expected.of_pairs[i];
        wrong += geoidx_query_sssd(query, pair[1], pair[0], &distance) != GEOIDX_OK;
        wrong += distance != expected.of_pairs[i];
        wrong += geoidx_msad(index, pair, 2, distances.data(), count) != GEOIDX_OK;
        wrong += distances != expected.of_sources[i];
        wrong += geoidx_query_msad(query, pair, 2, distances.data(), count) != GEOIDX_OK;
        wrong += distances != expected.of_sources[i];
        std::vector<uint32_t> nearest(count);
        wrong += geoidx_query_nearest_sources(query, pair, 2, nearest.data(), distances.data(), count) !=
                 GEOIDX_OK;
        wrong += distances != expected.of_sources[i];
        wrong += geoidx_query_ssad_batch(query, pair, 1, distances.data(), count) != GEOIDX_OK;
        wrong += distances != expected.of_first[i];
        wrong += geoidx_query_prepare(query, pair[0]) != GEOIDX_OK;
        wrong += geoidx_query_prepared(query, &pair[1], 1, &distance) != GEOIDX_OK;
        wrong += distance != expected.prepared[i];
        wrong += geoidx_sssd_batch(index, expected.pairs.data(), ROUNDS, batch.data()) != GEOIDX_OK;
        wrong += batch != expected.of_pairs;
        wrong += geoidx_sssd(index, count + thread, 0, &distance) != GEOIDX_ERROR_INVALID_ARGUMENT;
        wrong += std::string(geoidx_last_error()).find(std::to_string(count + thread)) == std::string::npos;
        geoidx_info info{};
        info.struct_size = sizeof info;
        wrong += geoidx_get_info(index, &info) != GEOIDX_OK || info.vertex_count != count;
    }
    wrong += farthest_points(query, expected.pairs[0]) != expected.farthest;
    geoidx_query_close(query);
    return wrong;
}

// The file with valid checksums, but without the last byte of the last image of each section of tables.
Bytes damaged_in_tables(const Bytes& file) {
    const auto container = format::Container::parse(file, INDEX_TAGS);
    format::ContainerWriter writer(container.mesh_fingerprint());
    for (const format::Section& section : container.sections()) {
        if (section.codec != format::Codec::Png && section.codec != format::Codec::ByteImages) {
            writer.add_bytes(section.tag, container.read_bytes(section.tag, section.raw_size));
            continue;
        }
        format::ByteReader stored(std::span<const std::byte>(file).subspan(section.offset));
        std::vector<Bytes> images;
        for (const auto image : container.png_streams(section.tag, stored.u32()))
            images.emplace_back(image.begin(), image.end());
        images.back().pop_back();
        writer.add_encoded_images(section.tag, section.codec, images, section.raw_size);
    }
    return writer.finish();
}

IndexHandle open_in(CountingAllocator& allocator, const Bytes& file) {
    geoidx_open_options options;
    geoidx_open_options_init(&options);
    options.allocator = allocator.get();
    geoidx* index = nullptr;
    require_success(geoidx_open_memory(file.data(), file.size(), &options, &index));
    return IndexHandle(index);
}

void check_eight_threads(const TestMesh& mesh, geoidx_build_options options, uint32_t codec) {
    const uint32_t count = mesh.vertex_count();
    CountingAllocator allocator;
    options.exact_vertices = 30;
    options.threads = 3;
    const auto built = build(mesh, options);
    const Expected expected = single_threaded(built.get(), count);
    const Bytes file = save(built.get(), codec);
    // Nobody has asked this one for a pair, so that the threads race for the first one.
    IndexHandle index = open_in(allocator, file);
    std::vector<uint64_t> wrong(THREADS, 0);
    {
        std::barrier start(THREADS);
        std::vector<std::jthread> threads;
        for (uint32_t t = 0; t < THREADS; ++t)
            threads.emplace_back([&, t] {
                start.arrive_and_wait();
                wrong[t] = differences(index.get(), t, count, expected);
            });
    }
    for (uint64_t differing : wrong) CHECK(differing == 0);
    index.reset();
    CHECK(allocator.blocks() == 0);
    CHECK(allocator.mistakes() == 0);
}

}

TEST_CASE("eight threads on one index get the answers of one thread") {
    for (uint32_t engine : {GEOIDX_ENGINE_GRAPH, GEOIDX_ENGINE_OVERLAY}) {
        auto options = build_options(GEOIDX_METRIC_EDGES, 3);
        options.engine = engine;
        check_eight_threads(hills(20, 18), options, GEOIDX_CODEC_PACKED);
    }
    for (const uint32_t codec : {GEOIDX_CODEC_PACKED, GEOIDX_CODEC_MAPPED})
        check_eight_threads(hills(13, 12), default_options(), codec);
}

TEST_CASE("building: the number of threads does not change a byte") {
    for (uint32_t metric : {GEOIDX_METRIC_EXACT, GEOIDX_METRIC_EDGES})
        for (double delta : {0.0, 2.0}) {
            auto options = build_options(metric, 2, delta);
            options.threads = 1;
            const Bytes expected = save(build(hills(20, 19), options).get());
            for (uint32_t threads : {2u, 3u, 7u}) {
                CAPTURE(threads);
                options.threads = threads;
                CHECK(save(build(hills(20, 19), options).get()) == expected);
            }
        }
}

TEST_CASE("opening: the number of threads changes nothing") {
    const TestMesh mesh = hills(60, 50);
    for (uint32_t engine : {GEOIDX_ENGINE_GRAPH, GEOIDX_ENGINE_OVERLAY}) {
        auto build_with = build_options(GEOIDX_METRIC_EDGES, 2);
        build_with.engine = engine;
        const auto index = build(mesh, build_with);
        REQUIRE(info_of(index.get()).table_entries > 4 << 16); // worth several threads
        const Bytes file = save(index.get());
        const auto damaged = damaged_in_tables(file);
        for (uint32_t threads : {0u, 1u, 2u, 5u}) {
            geoidx_open_options options;
            geoidx_open_options_init(&options);
            options.threads = threads;
            geoidx* opened = nullptr;
            require_success(geoidx_open_memory(file.data(), file.size(), &options, &opened));
            CHECK(save(opened) == file);
            geoidx_close(opened);
            CHECK(geoidx_open_memory(damaged.data(), damaged.size(), &options, &opened) ==
                  GEOIDX_ERROR_CORRUPT);
        }
        geoidx_open_options options;
        geoidx_open_options_init(&options);
        options.threads = 1025;
        geoidx* opened = nullptr;
        CHECK(geoidx_open_memory(file.data(), file.size(), &options, &opened) ==
              GEOIDX_ERROR_INVALID_ARGUMENT);
    }
}

TEST_CASE("saving, opening and querying at once") {
    const TestMesh mesh = hills(12, 11);
    const auto index = build(mesh, build_options(GEOIDX_METRIC_EDGES, 2));
    const Bytes bytes = save(index.get());
    const auto expected = msad(index.get(), 0, 132);
    std::atomic<uint64_t> wrong = 0;
    {
        std::vector<std::jthread> threads;
        for (uint32_t t = 0; t < 4; ++t)
            threads.emplace_back([&] {
                Bytes saved(bytes.size());
                uint64_t size = 0;
                wrong +=
                    geoidx_save_memory(index.get(), nullptr, saved.data(), saved.size(), &size) != GEOIDX_OK;
                wrong += saved != bytes;
                geoidx* opened = nullptr;
                wrong += geoidx_open_memory(bytes.data(), bytes.size(), nullptr, &opened) != GEOIDX_OK;
                std::vector<float> distances(132);
                const uint32_t source = 0;
                wrong += geoidx_msad(opened, &source, 1, distances.data(), 132) != GEOIDX_OK;
                wrong += distances != expected;
                geoidx_close(opened);
            });
    }
    CHECK(wrong == 0);
}
