// The caller's allocator: asked and paid back exactly, and failing at every possible call.

#include <functional>
#include <memory_resource>

#include "tests/capi/calls.h"
#include "tests/capi/counting_allocator.h"
#include "tests/capi/refusals.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

namespace {

// Runs `action` with an allocator that fails at the k-th call and, in a second round, only at that one, for
// every k until none fails any more. The action releases everything that it made.
void fail_at_every_call(const std::function<geoidx_status(const geoidx_allocator&)>& action) {
    for (bool recovers : {false, true}) {
        for (uint64_t k = 0;; ++k) {
            CAPTURE(k);
            CAPTURE(recovers);
            CountingAllocator allocator(k, recovers);
            const geoidx_status status = action(allocator.get());
            CHECK(allocator.mistakes() == 0);
            CHECK(allocator.blocks() == 0);
            REQUIRE(k < 10000);
            if (allocator.failures() == 0) {
                CHECK(status == GEOIDX_OK);
                CHECK(k > 5);
                break;
            }
            REQUIRE((status == GEOIDX_OK || status == GEOIDX_ERROR_OUT_OF_MEMORY));
        }
    }
}

geoidx_open_options opening_with(const geoidx_allocator& allocator) {
    geoidx_open_options options;
    geoidx_open_options_init(&options);
    options.allocator = allocator;
    return options;
}

class WithoutDefaultMemory {
public:
    WithoutDefaultMemory() : before_(std::pmr::set_default_resource(std::pmr::null_memory_resource())) {}
    ~WithoutDefaultMemory() { std::pmr::set_default_resource(before_); }
    WithoutDefaultMemory(const WithoutDefaultMemory&) = delete;
    WithoutDefaultMemory& operator=(const WithoutDefaultMemory&) = delete;

private:
    std::pmr::memory_resource* const before_;
};

TestMesh small_mesh() { return hills(9, 8); }

// For each engine; options have two levels.
void for_each_engine(const std::function<void(const geoidx_build_options& options)>& test) {
    for (uint32_t engine : {GEOIDX_ENGINE_GRAPH, GEOIDX_ENGINE_OVERLAY}) {
        CAPTURE(engine);
        auto options = build_options(GEOIDX_METRIC_EXACT, 2);
        options.engine = engine;
        test(options);
    }
}

// For a file of each engine.
void for_each_file(const std::function<void(const Bytes& file)>& test) {
    for_each_engine(
        [&](const geoidx_build_options& options) { test(save(build(small_mesh(), options).get())); });
}

}

TEST_CASE("the index lives in the caller's memory, which gets everything back") {
    for_each_engine([](const geoidx_build_options& engine_options) {
        CountingAllocator allocator;
        auto options = engine_options;
        options.allocator = allocator.get();
        auto index = build(small_mesh(), options);
        const size_t entry_size = options.engine == GEOIDX_ENGINE_GRAPH ? sizeof(float) : sizeof(uint16_t);
        const uint64_t entries = info_of(index.get()).table_entries;
        CHECK(allocator.bytes() >= entries * entry_size);
        sssd(index.get(), 0, 71);
        const auto distances = msad(index.get(), 5, 72);
        const uint64_t calls = allocator.calls();
        CHECK(msad(index.get(), 5, 72) == distances);
        CHECK(allocator.calls() == calls); // the scratch of the first call was kept

        CountingAllocator opening;
        const auto open_options = opening_with(opening.get());
        const Bytes bytes = save(index.get());
        geoidx* opened = nullptr;
        require_success(geoidx_open_memory(bytes.data(), bytes.size(), &open_options, &opened));
        CHECK(opening.bytes() >= entries * entry_size);
        geoidx_query* query = nullptr;
        const uint64_t before = opening.bytes();
        require_success(geoidx_query_create(opened, &query));
        CHECK(opening.bytes() > before);
        geoidx_query_close(query);
        CHECK(opening.bytes() == before);
        geoidx_close(opened);
        CHECK(opening.blocks() == 0);
        CHECK(opening.mistakes() == 0);

        index.reset();
        CHECK(allocator.blocks() == 0);
        CHECK(allocator.mistakes() == 0);
    });
}

namespace {

IndexHandle open_in(CountingAllocator& allocator, const Bytes& file, uint32_t flags) {
    auto options = opening_with(allocator.get());
    options.flags = flags;
    geoidx* index = nullptr;
    require_success(geoidx_open_memory(file.data(), file.size(), &options, &index));
    return IndexHandle(index);
}

}

TEST_CASE("what pairs need takes memory at the first pair, or when opening if that is asked for" *
          doctest::skip(SANITIZED)) {
    geoidx_build_options options;
    geoidx_build_options_init(&options);
    constexpr uint32_t SIDE = 40, COUNT = SIDE * SIDE;
    const Bytes file = save(build(hills(SIDE, SIDE), options).get());
    CountingAllocator late_memory, early_memory;
    const IndexHandle late = open_in(late_memory, file, 0),
                      early = open_in(early_memory, file, GEOIDX_OPEN_PAIRS);
    CHECK(msad(late.get(), 5, COUNT) == msad(early.get(), 5, COUNT));
    CHECK(late_memory.bytes() < early_memory.bytes());
    for (uint32_t target = 0; target < COUNT; target += 7)
        CHECK(sssd(late.get(), COUNT / 2, target) == sssd(early.get(), COUNT / 2, target));
    CHECK(late_memory.bytes() == early_memory.bytes());
}

TEST_CASE("flags of opening that mean nothing are refused") {
    geoidx_open_options options;
    geoidx_open_options_init(&options);
    CHECK(options.flags == 0);
    options.flags = GEOIDX_OPEN_PAIRS | GEOIDX_OPEN_BORROW | 8;
    const Bytes file = save(build(small_mesh(), build_options()).get());
    geoidx* index = not_null();
    CHECK(geoidx_open_memory(file.data(), file.size(), &options, &index) == GEOIDX_ERROR_INVALID_ARGUMENT);
    CHECK(index == nullptr);
}

// A program may have made another resource the default, which need not bear threads, nor memory that is freed
// after it. The second mesh is flat, so that its edges are flipped.
TEST_CASE("the default memory resource of the program is not used") {
    const WithoutDefaultMemory without_default;
    for (const TestMesh& mesh : {small_mesh(), grid(13, 6, 0.25)})
        for_each_engine([&](const geoidx_build_options& options) {
            auto with_threads = options;
            with_threads.threads = 2;
            const auto built = build(mesh, with_threads);
            for (const uint32_t codec : {GEOIDX_CODEC_PACKED, GEOIDX_CODEC_LOSSLESS, GEOIDX_CODEC_MAPPED}) {
                const Bytes file = save(built.get(), codec);
                CHECK(geoidx_verify(file.data(), file.size(), nullptr, nullptr) == GEOIDX_OK);
                const auto opened = open(file);
                CHECK(save(opened.get(), GEOIDX_CODEC_PACKED) == save(built.get(), GEOIDX_CODEC_PACKED));
                CHECK(sssd(opened.get(), 0, 70) > 0);
                CHECK(msad(opened.get(), 0, mesh.vertex_count())[70] > 0);
            }
        });
}

TEST_CASE("out of memory while opening") {
    for_each_file([](const Bytes& bytes) {
        fail_at_every_call([&](const geoidx_allocator& allocator) {
            const auto options = opening_with(allocator);
            geoidx* index = nullptr;
            const geoidx_status status = geoidx_open_memory(bytes.data(), bytes.size(), &options, &index);
            CHECK((status == GEOIDX_OK) == (index != nullptr));
            geoidx_close(index);
            return status;
        });
    });
}

TEST_CASE("out of memory while building") {
    const TestMesh mesh = hills(5, 5);
    const geoidx_mesh view = mesh.view();
    for_each_engine([&](const geoidx_build_options& engine_options) {
        auto options = engine_options;
        options.metric = GEOIDX_METRIC_EDGES;
        options.patches[0] = options.patches[1] = 2;
        fail_at_every_call([&](const geoidx_allocator& allocator) {
            options.allocator = allocator;
            geoidx* index = nullptr;
            const geoidx_status status = geoidx_build(&view, &options, &index);
            CHECK((status == GEOIDX_OK) == (index != nullptr));
            geoidx_close(index);
            return status;
        });
    });
}

// What failed must leave nothing behind that a later query stumbles on: each failure is followed by queries
// that have memory and must give the right answers.
TEST_CASE("out of memory during queries does no lasting harm") {
    for_each_file([](const Bytes& bytes) {
        const auto reference = open(bytes);
        const auto expected = msad(reference.get(), 7, 72);
        const auto expected_pair = sssd(reference.get(), 3, 68);
        uint64_t failed = 0;
        for (uint64_t k = 0; k < 60; ++k)
            for (bool recovers : {false, true})
                for (bool own_query : {false, true}) {
                    CAPTURE(k);
                    CAPTURE(own_query);
                    CountingAllocator allocator(UINT64_MAX, recovers);
                    const auto options = opening_with(allocator.get());
                    geoidx* index = nullptr;
                    require_success(geoidx_open_memory(bytes.data(), bytes.size(), &options, &index));
                    geoidx_query* query = nullptr;
                    std::vector<float> distances(72);
                    float distance = -1;
                    const auto check = [&](geoidx_status status) {
                        CHECK((status == GEOIDX_OK || status == GEOIDX_ERROR_OUT_OF_MEMORY));
                        failed += status != GEOIDX_OK;
                    };
                    const uint32_t source = 7;
                    const auto ask_msad = [&] {
                        return own_query ? geoidx_query_msad(query, &source, 1, distances.data(), 72)
                                         : geoidx_msad(index, &source, 1, distances.data(), 72);
                    };
                    const auto ask_sssd = [&] {
                        return own_query ? geoidx_query_sssd(query, 3, 68, &distance)
                                         : geoidx_sssd(index, 3, 68, &distance);
                    };
                    allocator.fail_at(own_query ? UINT64_MAX / 2 : k);
                    if (own_query) {
                        require_success(geoidx_query_create(index, &query));
                        allocator.fail_at(k);
                    }
                    check(ask_msad());
                    check(ask_sssd());
                    allocator.never_fail();
                    require_success(ask_msad());
                    CHECK(distances == expected);
                    require_success(ask_sssd());
                    CHECK(distance == expected_pair);
                    geoidx_query_close(query);
                    geoidx_close(index);
                    CHECK(allocator.blocks() == 0);
                    CHECK(allocator.mistakes() == 0);
                }
        CHECK(failed > 0);
    });
}

TEST_CASE("out of memory while creating a query") {
    for_each_file([](const Bytes& bytes) {
        CountingAllocator allocator;
        const auto options = opening_with(allocator.get());
        geoidx* index = nullptr;
        require_success(geoidx_open_memory(bytes.data(), bytes.size(), &options, &index));
        const IndexHandle owned(index);
        const size_t blocks = allocator.blocks();
        uint64_t k = 0;
        for (;; ++k) {
            REQUIRE(k < 1000);
            allocator.fail_at(k);
            geoidx_query* query = nullptr;
            const geoidx_status status = geoidx_query_create(index, &query);
            if (status == GEOIDX_OK) {
                geoidx_query_close(query);
                CHECK(allocator.blocks() == blocks);
                break;
            }
            CHECK(status == GEOIDX_ERROR_OUT_OF_MEMORY);
            CHECK(query == nullptr);
            CHECK(allocator.blocks() == blocks);
        }
        CHECK(k > 3);
    });
}
