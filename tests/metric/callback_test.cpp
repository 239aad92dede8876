#include "src/metric/callback.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>

#include <doctest/doctest.h>

#include "format/error.h"
#include "tests/support/oracles.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// Ids of the caller on a line, |a - b| apart; `bad` is answered for the pair given.
struct Line {
    uint32_t bad_source = NONE, bad_target = NONE;
    double bad = 0;
    geoidx_status status = GEOIDX_OK;
    uint64_t asked = 0;

    static geoidx_status distances(void* user, uint32_t source, const uint32_t* targets, uint32_t count,
                                   double* out) {
        Line& line = *static_cast<Line*>(user);
        for (uint32_t i = 0; i < count; ++i, ++line.asked)
            out[i] = source == line.bad_source && targets[i] == line.bad_target
                         ? line.bad
                         : std::abs(static_cast<double>(source) - static_cast<double>(targets[i]));
        return line.status;
    }
};

const std::vector<uint32_t> IDS{10, 40, 20, 100};

std::vector<double> solve(FieldSolver& solver, std::span<const uint32_t> sources,
                          std::span<const uint32_t> targets = {}) {
    solver.solve(sources, targets);
    std::vector<double> result;
    for (uint32_t v = 0; v < IDS.size(); ++v) result.push_back(solver.distance(v));
    return result;
}

}

TEST_CASE("callback metric: cancelled between two questions, a solver can be used again") {
    struct Cancelling {
        std::atomic<bool> flag{false};
        uint32_t asked = 0;
        static geoidx_status distances(void* user, uint32_t, const uint32_t*, uint32_t count, double* out) {
            auto& self = *static_cast<Cancelling*>(user);
            std::fill_n(out, count, 1.0);
            if (++self.asked == 2) self.flag = true;
            return GEOIDX_OK;
        }
    } callback;
    const auto solver = CallbackMetric(Cancelling::distances, &callback, IDS).make_solver();
    solver->cancel_when(callback.flag);
    const std::vector<uint32_t> all{0, 1, 2, 3};
    CHECK_THROWS_WITH_AS(solver->solve(all, {}), doctest::Contains("cancelled"), Error);
    CHECK(callback.asked == 2);
    callback.flag = false;
    solver->solve(all, {});
    CHECK(callback.asked == 6);
}

TEST_CASE("callback metric: asks by the caller's ids, takes the nearest of several sources") {
    Line line;
    const auto solver = CallbackMetric(Line::distances, &line, IDS).make_solver();
    const std::vector<uint32_t> one{2}, two{1, 2};
    CHECK(solve(*solver, one) == std::vector<double>{10, 20, 0, 80});
    CHECK(solve(*solver, two) == std::vector<double>{10, 0, 0, 60});
    CHECK(solver->nearest(0) == 1);
    CHECK(solver->nearest(3) == 0);
    // Targets only are asked for; nothing of the solve before is left.
    const std::vector<uint32_t> target{3};
    line.asked = 0;
    CHECK(solve(*solver, one, target) == std::vector<double>{UNREACHABLE, UNREACHABLE, UNREACHABLE, 80});
    CHECK(line.asked == 1);
}

TEST_CASE("callback metric: infinity is an answer, vertices left unwritten are unreachable") {
    Line line{20, 40, UNREACHABLE};
    const std::vector<uint32_t> one{2};
    const auto solver = CallbackMetric(Line::distances, &line, IDS).make_solver();
    CHECK(solve(*solver, one) == std::vector<double>{10, UNREACHABLE, 0, 80});
    CHECK(solver->nearest(1) == NONE);
    const auto silent = [](void*, uint32_t, const uint32_t*, uint32_t, double*) { return geoidx_status{0}; };
    CHECK(solve(*CallbackMetric(silent, nullptr, IDS).make_solver(), one)[3] == UNREACHABLE);
}

TEST_CASE("callback metric: NaN, negative answers and failures are errors that name the pair") {
    const std::vector<uint32_t> one{2};
    std::string detail;
    for (const double bad : {std::nan(""), -1e-300, -1.0, -UNREACHABLE}) {
        Line line{20, 40, bad};
        const auto solver = CallbackMetric(Line::distances, &line, IDS).make_solver();
        CHECK(failure_of([&] { solver->solve(one, {}); }, &detail) == GEOIDX_ERROR_CALLBACK);
        CHECK(detail.find("20") != std::string::npos);
        CHECK(detail.find("40") != std::string::npos);
        // The solver goes on to work once the callback does.
        line.bad = 20;
        CHECK(solve(*solver, one) == std::vector<double>{10, 20, 0, 80});
    }
    for (const geoidx_status status : {1, -1, -9999}) {
        Line line;
        line.status = status;
        const auto solver = CallbackMetric(Line::distances, &line, IDS).make_solver();
        CHECK(failure_of([&] { solver->solve(one, {}); }, &detail) == GEOIDX_ERROR_CALLBACK);
        CHECK(detail.find(std::to_string(status)) != std::string::npos);
    }
}
