// Distances rounded to codes.
#include "src/overlay/tables/codes.h"

#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "tests/overlay/steps_of.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// Up to `most`.
double any(double most, std::mt19937& random) {
    return std::uniform_real_distribution<double>(0, most)(random);
}

}

TEST_CASE("table codes: the nearest step, and what has no step of its own") {
    constexpr float QUANTUM = 0.25f;
    CHECK(TableCode::nearest_to(0, QUANTUM) == 0);
    CHECK(TableCode::nearest_to(1e-30f, QUANTUM) == 1); // different vertices stay apart
    CHECK(TableCode::nearest_to(0.3f, QUANTUM) == 1);
    CHECK(TableCode::nearest_to(0.4f, QUANTUM) == 2);
    CHECK(TableCode::nearest_to(32766 * QUANTUM, QUANTUM) == 0x7ffe);
    CHECK(TableCode::nearest_to(32767 * QUANTUM, QUANTUM) == 0x7ffe); // not the code of no path
    CHECK(TableCode::nearest_to(3e38f, 1e-38f) == 0x7ffe);
    CHECK(TableCode::nearest_to(INFINITE, QUANTUM) == 0x7fff);
    CHECK(TableCode::nearest_to(INFINITE, 0) == 0x7fff);
    CHECK(TableCode::nearest_to(5, 0) == 0);
    CHECK(TableCode::distance(0x7fff, QUANTUM) == INFINITE);
    CHECK(TableCode::distance(0, QUANTUM) == 0);
    CHECK(TableCode::distance(0x7ffe, QUANTUM) == 8191.5f);
}

TEST_CASE("table codes: rounding is by half a step at most, whatever the quantum") {
    std::mt19937 random(1);
    for (const double quantum : {1e-30, 3e-5, 1.0, 7e20})
        for (int i = 0; i < 2000; ++i) {
            const double steps = 0.5 + any(32765, random);
            const auto step = static_cast<float>(quantum), distance = static_cast<float>(steps * quantum);
            const uint16_t code = TableCode::nearest_to(distance, step);
            REQUIRE(std::abs(double{TableCode::distance(code, step)} - double{distance}) <=
                    0.5 * double{step} + 1e-6 * double{distance});
        }
}

TEST_CASE("table codes: converted to steps of another quantum") {
    for (const uint32_t code : {0u, 1u, 2u, 12345u, 0x7ffeu, 0x7fffu})
        CHECK(TableCode::converted(static_cast<uint16_t>(code), 0.3f, 0.3f) == code);
    CHECK(TableCode::converted(100, 1, 0.5f) == 200);
    CHECK(TableCode::converted(100, 1, 8) == 13); // 12.5 steps
    CHECK(TableCode::converted(3, 1, 1000) == 1); // no distance becomes 0
    CHECK(TableCode::converted(0, 1, 1000) == 0);
    CHECK(TableCode::converted(30000, 1, 0.5f) == 0x7ffe); // nor no path
    CHECK(TableCode::converted(0x7fff, 1, 1000) == 0x7fff);
    CHECK(TableCode::converted(0x7fff, 1000, 1) == 0x7fff);
    CHECK(TableCode::converted(77, 1, 0) == 77); // a patch without distances has no quantum
}

TEST_CASE("source codes: steps beyond the nearest one, within half a step of the distances") {
    std::mt19937 random(2);
    for (const float quantum : {1e-20f, 0.01f, 3.f})
        for (const double offset : {0.0, 0.4, 100.6, 200000.0, 1e10, 1e15}) {
            std::vector<float> distances;
            for (int i = 0; i < 200; ++i)
                distances.push_back(static_cast<float>((offset + any(32000, random)) * double{quantum}));
            const StepsOf steps(distances, quantum);
            const float nearest = *std::min_element(distances.begin(), distances.end());
            const double nearest_steps = double{nearest} / double{quantum};
            CHECK(double{steps.nearest()} <= nearest_steps * (1 + 1e-6));
            CHECK(double{steps.nearest()} > nearest_steps * (1 - 1e-6) - 1);
            for (const float distance : distances) {
                const double decoded = 32768.0 + double{steps.nearest()} + steps.code(distance);
                REQUIRE(std::abs(decoded - double{distance} / double{quantum}) <=
                        0.5 + 2e-7 * (offset + 32000));
            }
        }
}

TEST_CASE("source codes: what is not reached, what is too far, and what has no quantum") {
    const std::vector<float> distances{2, INFINITE, 1e30f}, none{INFINITE, INFINITE};
    const StepsOf steps(distances, 1);
    CHECK(steps.nearest() == 2);
    CHECK(steps.code(2) == -32768);
    CHECK(steps.code(INFINITE) == SourceCode::UNREACHED);
    CHECK(steps.code(1e30f) < SourceCode::UNREACHED); // too far is still reached
    CHECK(steps.code(1e30f) == steps.code(50000));
    CHECK(StepsOf(none, 1).nearest() == 0);
    CHECK(StepsOf(none, 1).code(INFINITE) == SourceCode::UNREACHED);
    CHECK(StepsOf(std::vector<float>{0, 0}, 0).code(0) == -32768);
}

// Kernels add them in 16 bits.
TEST_CASE("source codes: every sum fits, and sums of what is not reached are told apart") {
    const StepsOf steps(std::vector<float>{0}, 1);
    const int32_t nearest = steps.code(0), farthest = steps.code(1e9f), unreached = steps.code(INFINITE);
    for (const int32_t code : {nearest, farthest, unreached})
        for (const int32_t entry : {0, 0x7ffe, 0x7fff}) {
            CHECK(code + entry >= INT16_MIN);
            CHECK(code + entry <= INT16_MAX);
            if (code == unreached || entry == 0x7fff) CHECK(code + entry >= SourceCode::NO_SUM);
        }
    CHECK(nearest + 0x7ffe < SourceCode::NO_SUM); // of the nearest one, every path counts
}
