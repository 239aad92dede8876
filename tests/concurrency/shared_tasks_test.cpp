// The only threads of the library: every task once, also on the calling thread, and errors of any thread
// reach the caller.

#include <atomic>
#include <chrono>
#include <mutex>
#include <new>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include "src/base/shared_tasks.h"

using namespace geodesic;

TEST_CASE("shared tasks: every task once, the calling thread among the others") {
    for (uint32_t threads : {1u, 2u, 5u})
        for (size_t count : {size_t{0}, size_t{1}, size_t{2000}}) {
            std::vector<std::atomic<uint32_t>> called(count);
            std::atomic<uint32_t> wrong = 0;
            SharedTasks tasks(count, [&](uint32_t thread, size_t task) {
                ++called[task];
                wrong += thread >= threads;
            });
            CHECK(tasks.start_threads(1, threads) == threads - 1);
            tasks.work(0);
            tasks.finish();
            for (const auto& calls : called) CHECK(calls == 1);
            CHECK(wrong == 0);
        }
}

TEST_CASE("shared tasks: an error of a started thread reaches the caller, which works too") {
    // So many that the thread that fails has been heard before the caller is through, however busy the
    // machine is.
    constexpr uint32_t MANY = 1'000'000'000;
    for (int repetition = 0; repetition < 20; ++repetition) {
        std::atomic<bool> has_failed = false;
        std::atomic<uint32_t> later = 0;
        const auto caller = std::this_thread::get_id();
        SharedTasks tasks(MANY, [&](uint32_t, size_t) {
            if (std::this_thread::get_id() != caller) {
                has_failed = true;
                throw std::bad_alloc();
            }
            while (!has_failed) std::this_thread::yield();
            ++later;
        });
        REQUIRE(tasks.start_threads(1, 2) == 1);
        tasks.work(0);
        CHECK_THROWS_AS(tasks.finish(), std::bad_alloc);
        CHECK(later < MANY - 1);
    }
}

TEST_CASE("shared tasks: an error on the calling thread waits for the others") {
    std::atomic<uint32_t> begun = 0, ended = 0;
    const auto caller = std::this_thread::get_id();
    SharedTasks tasks(1000, [&](uint32_t, size_t) {
        if (std::this_thread::get_id() == caller) {
            while (begun == 0) std::this_thread::yield();
            throw 42;
        }
        ++begun;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        ++ended;
    });
    REQUIRE(tasks.start_threads(1, 3) == 2);
    tasks.work(0);
    CHECK_THROWS_AS(tasks.finish(), int);
    CHECK(begun == ended);
}

TEST_CASE("shared tasks: given up, no further task begins") {
    std::atomic<uint32_t> begun = 0, ended = 0;
    {
        SharedTasks tasks(SIZE_MAX / 2, [&](uint32_t, size_t) {
            ++begun;
            std::this_thread::sleep_for(std::chrono::microseconds(100));
            ++ended;
        });
        REQUIRE(tasks.start_threads(0, 3) == 3);
        while (begun < 10) std::this_thread::yield();
        CHECK(!tasks.wait_for(std::chrono::milliseconds(1)));
    }
    CHECK(begun == ended);
}
