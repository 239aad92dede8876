// Progress of a build: what the callback is told, on which thread, and what cancelling does.

#include <set>
#include <thread>

#include "tests/capi/calls.h"
#include "tests/capi/counting_allocator.h"

using namespace geodesic::test;

namespace {

struct Log {
    std::thread::id thread = std::this_thread::get_id();
    uint64_t cancel_at = UINT64_MAX; // number of the call that returns 0
    std::vector<float> fractions;
    std::vector<std::string> stages;
    uint64_t on_other_threads = 0;

    static int32_t record(void* user, float fraction, const char* stage) {
        auto& log = *static_cast<Log*>(user);
        if (std::this_thread::get_id() != log.thread) ++log.on_other_threads;
        log.fractions.push_back(fraction);
        log.stages.push_back(stage ? stage : "(null)");
        return log.fractions.size() - 1 != log.cancel_at;
    }
};

constexpr uint32_t ENGINES[] = {GEOIDX_ENGINE_GRAPH, GEOIDX_ENGINE_OVERLAY};

geoidx_build_options options_with(Log& log, uint32_t engine, uint32_t threads) {
    auto options = build_options(GEOIDX_METRIC_EXACT, 2, 1.0);
    options.engine = engine;
    options.threads = threads;
    options.progress = Log::record;
    options.progress_user = &log;
    return options;
}

}

TEST_CASE("progress never falls, ends at 1 and comes on the calling thread") {
    for (uint32_t engine : ENGINES)
        for (uint32_t threads : {1u, 3u}) {
            CAPTURE(engine);
            Log log;
            build(hills(20, 20), options_with(log, engine, threads));
            REQUIRE(log.fractions.size() >= 5);
            CHECK(log.on_other_threads == 0);
            CHECK(log.fractions.front() >= 0);
            CHECK(log.fractions.back() == 1);
            for (size_t i = 1; i < log.fractions.size(); ++i) CHECK(log.fractions[i - 1] <= log.fractions[i]);
            for (const std::string& stage : log.stages) CHECK((!stage.empty() && stage != "(null)"));
            CHECK(std::set(log.stages.begin(), log.stages.end()).size() >= 3);
        }
}

namespace {

void cancel_at_every_call(uint32_t engine) {
    const TestMesh mesh = hills(12, 12);
    const geoidx_mesh view = mesh.view();
    std::set<std::string> cancelled_stages, all_stages;
    uint64_t cancelled = 0;
    for (uint64_t k = 0;; ++k) {
        CAPTURE(k);
        REQUIRE(k < 1000);
        Log log;
        log.cancel_at = k;
        CountingAllocator allocator;
        auto options = options_with(log, engine, 2);
        options.allocator = allocator.get();
        geoidx* index = nullptr;
        const geoidx_status status = geoidx_build(&view, &options, &index);
        all_stages.insert(log.stages.begin(), log.stages.end());
        if (log.fractions.size() <= k) { // it was done before
            CHECK(status == GEOIDX_OK);
            geoidx_close(index);
            CHECK(allocator.blocks() == 0);
            break;
        }
        CHECK(status == GEOIDX_ERROR_CANCELLED);
        CHECK(index == nullptr);
        CHECK(log.fractions.size() == k + 1); // not asked again
        CHECK(allocator.blocks() == 0);
        CHECK(std::string(geoidx_last_error()).find("cancel") != std::string::npos);
        cancelled_stages.insert(log.stages.back());
        ++cancelled;
    }
    CHECK(cancelled_stages == all_stages);
    CHECK(cancelled >= 5);
}

}

TEST_CASE("cancelling at any call stops the build and leaks nothing") {
    for (uint32_t engine : ENGINES) {
        CAPTURE(engine);
        cancel_at_every_call(engine);
    }
}
