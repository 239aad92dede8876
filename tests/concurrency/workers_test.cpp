// The threads of a build: every task once, the first error wins, cancelling stops.

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include <doctest/doctest.h>

#include "format/error.h"
#include "src/metric/workers.h"

using namespace geodesic;

namespace {

class NoMetric final : public Metric {
public:
    std::unique_ptr<FieldSolver> make_solver() const override {
        class Solver final : public FieldSolver {
        public:
            Solver() : FieldSolver(1) {}

        private:
            void run(const FieldRequest&) override {}
        };
        ++made;
        return std::make_unique<Solver>();
    }

    mutable std::atomic<uint32_t> made = 0;
};

const NoMetric no_metric;

std::string message_of(Workers& workers, size_t count,
                       const std::function<void(FieldSolver&, size_t)>& task) {
    try {
        workers.run(count, task);
        return "";
    } catch (const std::runtime_error& error) {
        return error.what();
    }
}

}

TEST_CASE("workers: every task once, each thread with a solver of its own") {
    for (uint32_t threads : {1u, 2u, 5u}) {
        const NoMetric metric;
        Workers workers(metric, threads, {});
        CHECK(metric.made == threads);
        for (size_t count : {size_t{0}, size_t{1}, size_t{3}, size_t{2000}}) {
            std::vector<std::atomic<uint32_t>> called(count);
            std::mutex mutex;
            std::map<FieldSolver*, std::set<std::thread::id>> users;
            workers.run(count, [&](FieldSolver& solver, size_t i) {
                ++called[i];
                const std::lock_guard lock(mutex);
                users[&solver].insert(std::this_thread::get_id());
            });
            for (const auto& calls : called) CHECK(calls == 1);
            CHECK(users.size() <= threads);
            CHECK(users.empty() == (count == 0));
            for (const auto& [solver, ids] : users) CHECK(ids.size() == 1);
        }
    }
}

TEST_CASE("workers: zero threads means one per processor") {
    const NoMetric metric;
    Workers workers(metric, 0, {});
    CHECK(metric.made == std::max(1u, std::thread::hardware_concurrency()));
}

TEST_CASE("workers: results are visible after run, whichever thread wrote them") {
    Workers workers(no_metric, 4, {});
    std::vector<size_t> result(5000, 0); // written without a lock, as tables are
    workers.run(result.size(), [&](FieldSolver&, size_t i) { result[i] = i * i; });
    uint64_t wrong = 0;
    for (size_t i = 0; i < result.size(); ++i) wrong += result[i] != i * i;
    CHECK(wrong == 0);
}

TEST_CASE("workers: of several errors the one of the smallest number wins, and later tasks are dropped") {
    for (int repetition = 0; repetition < 20; ++repetition) {
        Workers workers(no_metric, 4, {});
        // The first four tasks fail, the later ones earlier.
        std::atomic<uint32_t> started = 0, later = 0;
        const std::string message = message_of(workers, 100000, [&](FieldSolver&, size_t i) {
            if (i >= 4) {
                ++later;
                return;
            }
            ++started;
            while (started < 4) std::this_thread::yield();
            std::this_thread::sleep_for(std::chrono::microseconds(500 * (4 - i)));
            throw std::runtime_error("task " + std::to_string(i));
        });
        CHECK(message == "task 0");
        CHECK(later < 100000 - 4);
        // They can be used again.
        std::atomic<uint32_t> again = 0;
        workers.run(10, [&](FieldSolver&, size_t) { ++again; });
        CHECK(again == 10);
    }
}

TEST_CASE("workers: an error that is no std::exception arrives too") {
    Workers workers(no_metric, 2, {});
    CHECK_THROWS_AS(workers.run(3,
                                [](FieldSolver&, size_t i) {
                                    if (i == 1) throw 42;
                                }),
                    int);
}

TEST_CASE("workers: cancelling stops the run and every later one") {
    std::atomic<bool> cancel = false;
    uint32_t reports = 0;
    Workers workers(no_metric, 3, [&](double, const char*) {
        ++reports;
        return !cancel;
    });
    workers.begin_stage("first", 0.5);
    workers.check_cancelled();
    std::atomic<uint64_t> done = 0;
    const auto status_of = [&](const std::function<void()>& action) {
        try {
            action();
            return GEOIDX_OK;
        } catch (const Error& error) {
            return static_cast<decltype(GEOIDX_OK)>(error.status);
        }
    };
    // Long enough that it ends only because it is cancelled: by the time the calling thread reports.
    const auto run_forever = [&] {
        workers.run(SIZE_MAX / 2, [&](FieldSolver&, size_t) {
            if (++done == 50) cancel = true;
            std::this_thread::sleep_for(std::chrono::microseconds(100));
        });
    };
    CHECK(status_of(run_forever) == GEOIDX_ERROR_CANCELLED);
    CHECK(done >= 50);
    const uint32_t before = reports;
    CHECK(status_of([&] { workers.check_cancelled(); }) == GEOIDX_ERROR_CANCELLED);
    CHECK(status_of([&] { workers.begin_stage("second", 1); }) == GEOIDX_ERROR_CANCELLED);
    CHECK(status_of([&] { workers.run(5, [](FieldSolver&, size_t) {}); }) == GEOIDX_ERROR_CANCELLED);
    CHECK(reports == before); // not asked again
}

TEST_CASE("workers: a task may look whether the work was cancelled") {
    std::atomic<bool> cancel = false;
    Workers workers(no_metric, 2, [&](double, const char*) { return !cancel; });
    cancel = true;
    CHECK_THROWS_AS(workers.run(2,
                                [&](FieldSolver&, size_t) {
                                    for (;;) {
                                        workers.check_cancelled();
                                        std::this_thread::yield();
                                    }
                                }),
                    Error);
}

TEST_CASE("workers: progress stays in its stage and never falls") {
    std::vector<double> fractions;
    Workers workers(no_metric, 2, [&](double fraction, const char*) {
        fractions.push_back(fraction);
        return true;
    });
    workers.begin_stage("first", 0.25);
    workers.run(10, [](FieldSolver&, size_t) {});
    CHECK(fractions.back() == 0.25);
    workers.run(3, [](FieldSolver&, size_t) {}); // a second run of one stage starts anew, but does not fall
    workers.run(0, [](FieldSolver&, size_t) {});
    workers.begin_stage("second", 1);
    CHECK(fractions.back() == 0.25);
    workers.run(7, [](FieldSolver&, size_t) {});
    CHECK(fractions.back() == 1);
    for (size_t i = 1; i < fractions.size(); ++i) CHECK(fractions[i - 1] <= fractions[i]);
}

TEST_CASE("workers: runs of a stage that says how many tasks it has follow each other") {
    std::vector<double> fractions;
    Workers workers(no_metric, 2, [&](double fraction, const char*) {
        fractions.push_back(fraction);
        return true;
    });
    workers.begin_stage("several", 0.5, 20);
    for (const auto& [tasks, fraction] : {std::pair{5, 0.125}, {0, 0.125}, {10, 0.375}, {5, 0.5}}) {
        workers.run(static_cast<size_t>(tasks), [](FieldSolver&, size_t) {});
        CHECK(fractions.back() == fraction);
    }
    workers.begin_stage("one", 1);
    workers.run(4, [](FieldSolver&, size_t) {});
    CHECK(fractions.back() == 1);
}
