// Progress of a build: what the callback is told, on which thread, and what cancelling does.

#include <algorithm>
#include <set>
#include <thread>

#include "tests/capi/calls.h"
#include "tests/capi/counting_allocator.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

namespace {

struct Log {
    std::thread::id thread = std::this_thread::get_id();
    uint64_t cancel_at = UINT64_MAX; // the number of the call that returns 0,
    std::string cancel_in;           // or a stage, of which the first one does
    std::vector<float> fractions;
    std::vector<std::string> stages;
    uint64_t on_other_threads = 0;

    static int32_t record(void* user, float fraction, const char* stage) {
        auto& log = *static_cast<Log*>(user);
        if (std::this_thread::get_id() != log.thread) ++log.on_other_threads;
        log.fractions.push_back(fraction);
        log.stages.push_back(stage ? stage : "(null)");
        return !log.is_cancelled();
    }

    bool is_cancelled() const {
        return fractions.size() == cancel_at + 1 || (!stages.empty() && stages.back() == cancel_in);
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

TEST_CASE("progress never falls, ends at 1 and comes on the calling thread" * doctest::skip(SANITIZED)) {
    for (uint32_t engine : ENGINES)
        for (uint32_t threads : {1u, 3u}) {
            CAPTURE(engine);
            Log log;
            build(hills(20, 20), options_with(log, engine, threads));
            REQUIRE(log.fractions.size() >= 8);
            CHECK(log.on_other_threads == 0);
            CHECK(log.fractions.front() >= 0);
            CHECK(log.fractions.back() == 1);
            for (size_t i = 1; i < log.fractions.size(); ++i) CHECK(log.fractions[i - 1] <= log.fractions[i]);
            for (const std::string& stage : log.stages) CHECK((!stage.empty() && stage != "(null)"));
            CHECK(std::set(log.stages.begin(), log.stages.end()).size() >= 3);
        }
}

TEST_CASE("progress goes on while large errors are looked for" * doctest::skip(SANITIZED)) {
    constexpr float LOOKING_BEGINS = 0.86f; // not before, with the default options
    Log log;
    auto options = default_options();
    options.progress = Log::record;
    options.progress_user = &log;
    build(rough_sheet(48, 16), options);
    CHECK(std::ranges::is_sorted(log.fractions));
    CHECK(log.fractions.back() == 1);
    const std::set<float> different(log.fractions.begin(), log.fractions.end());
    CHECK(std::ranges::count_if(different, [](float fraction) { return fraction > LOOKING_BEGINS; }) >= 5);
}

namespace {

void build_or_cancel(const TestMesh& mesh, uint32_t engine, Log& log) {
    CountingAllocator allocator;
    const geoidx_mesh view = mesh.view();
    auto options = options_with(log, engine, 2);
    options.allocator = allocator.get();
    geoidx* index = nullptr;
    const geoidx_status status = geoidx_build(&view, &options, &index);
    if (log.is_cancelled()) {
        CHECK(status == GEOIDX_ERROR_CANCELLED);
        CHECK(index == nullptr);
        CHECK(std::string(geoidx_last_error()).find("cancel") != std::string::npos);
    } else {
        CHECK(status == GEOIDX_OK);
        geoidx_close(index);
    }
    CHECK(allocator.blocks() == 0);
}

}

// The longer a build takes, the more often it reports, so how many calls there are is not known before.
TEST_CASE("cancelling at any call stops the build, which asks no more and leaks nothing") {
    const TestMesh mesh = hills(12, 12);
    for (uint32_t engine : ENGINES) {
        CAPTURE(engine);
        Log whole;
        build_or_cancel(mesh, engine, whole);
        REQUIRE(whole.fractions.size() >= 5);
        for (const std::string& stage : std::set(whole.stages.begin(), whole.stages.end())) {
            CAPTURE(stage);
            Log log;
            log.cancel_in = stage;
            build_or_cancel(mesh, engine, log);
            CHECK(log.stages.back() == stage);
            CHECK(std::ranges::count(log.stages, stage) == 1);
        }
        for (uint64_t k = 0; k < whole.fractions.size(); k += SANITIZED ? 3 : 1) {
            CAPTURE(k);
            Log log;
            log.cancel_at = k;
            build_or_cancel(mesh, engine, log);
            CHECK(log.fractions.size() <= k + 1);
        }
    }
}
