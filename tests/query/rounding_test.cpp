// Distances rounded to codes: the vectors of every instruction set against StepsOf, one distance at a time.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "src/overlay/kernels/dispatch.h"
#include "tests/overlay/steps_of.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

constexpr size_t BLOCK = SourceCode::BLOCK;

// The distances of one source from the places of a border.
using Distances = std::vector<float>;
using Codes = std::vector<int16_t>;

Codes codes_by_scalars(const Distances& distances, float quantum) {
    const StepsOf steps(distances, quantum);
    Codes codes;
    for (const float distance : distances) codes.push_back(steps.code(distance));
    return codes;
}

Codes codes_of_crossing(const Kernels& kernels, const Distances& distances, float quantum) {
    const size_t places = distances.size(), room = SourceCode::whole_blocks(places) + BLOCK;
    Distances distance(distances);
    distance.resize(room, INFINITE);
    const std::vector<float> gaps(room, NAN);
    const std::vector<int8_t> is_own(room, -1);
    Codes code(room, 77);
    std::vector<float> foot(room), height(room);
    const BorderFromSource border{places,      code.data(), distance.data(), gaps.data(),
                                  gaps.data(), foot.data(), height.data(),   quantum};
    kernels.prepare_crossing(border, is_own.data(), code.data(), foot.data(), height.data());
    code.resize(places);
    return code;
}

// Segments are gaps, so that the middles of none are nearer than the places. `all` has as many sources as it
// has entries, 1 or FIELDS_AT_ONCE.
std::vector<Codes> codes_of_sweep(const Kernels& kernels, const std::vector<Distances>& all, float quantum) {
    const size_t count = all.size(), places = all[0].size();
    const size_t room = (SourceCode::whole_blocks(places) + BLOCK) * count;
    std::vector<float> distance(room, INFINITE), middle_distance(room), nearest(count);
    for (size_t k = 0; k < places; ++k)
        for (size_t i = 0; i < count; ++i) distance[k * count + i] = all[i][k];
    const std::vector<float> gaps(places + BLOCK, NAN);
    Codes code(room, 77), middle(room, 77);
    (count == 1 ? kernels.prepare_sweep : kernels.prepare_sweep_each)(
        {places, distance.data(), gaps.data(), nullptr, quantum},
        {code.data(), middle.data(), nearest.data(), nullptr}, middle_distance.data());
    std::vector<Codes> codes(count, Codes(places));
    for (size_t i = 0; i < count; ++i)
        for (size_t k = 0; k < places; ++k) // of several sources, two places lie side by side
            codes[i][k] = count == 1 ? code[k] : code[k / 2 * 2 * FIELDS_AT_ONCE + 2 * i + k % 2];
    return codes;
}

// By every instruction set, for the crossing, the sweep of one source and that of several. Returns how many
// codes differ by more than `most`.
uint64_t count_different(const std::vector<Distances>& all, float quantum, int most) {
    uint64_t different = 0;
    const auto compare = [&](const Codes& codes, const Codes& expected) {
        REQUIRE(codes.size() == expected.size());
        for (size_t k = 0; k < codes.size(); ++k) different += std::abs(codes[k] - expected[k]) > most;
    };
    for (const Kernels& kernels : runnable_kernels()) {
        const auto of_each = codes_of_sweep(kernels, all, quantum);
        for (size_t i = 0; i < FIELDS_AT_ONCE; ++i) {
            const Codes expected = codes_by_scalars(all[i], quantum);
            compare(of_each[i], expected);
            compare(codes_of_sweep(kernels, {all[i]}, quantum)[0], expected);
            compare(codes_of_crossing(kernels, all[i], quantum), expected);
        }
    }
    return different;
}

}

TEST_CASE(
    "rounding: vectors give the codes that StepsOf gives, where the nearest place is whole steps away") {
    std::mt19937 random(11);
    // Powers of two, and distances that are 64ths of a step: nothing but the codes is rounded. Half a step
    // is rounded up.
    for (const float quantum : {0x1p-9f, 1.f, 0x1p7f})
        for (size_t places : {5u, 16u, 33u, 64u, 77u}) {
            std::vector<Distances> all(FIELDS_AT_ONCE, Distances(places));
            for (size_t i = 0; i < FIELDS_AT_ONCE; ++i) {
                const auto nearest = static_cast<float>(i * 3);
                for (float& distance : all[i])
                    distance = (nearest + static_cast<float>(random() % (32000 * 64)) / 64) * quantum;
                all[i][0] = (nearest + 0.5f) * quantum;
                all[i][1] = nearest * quantum;
                all[i][2] = (nearest + 32765.5f) * quantum;
                all[i][3] = (nearest + 40000) * quantum; // more steps than there are codes for
                all[i][4] = INFINITE;
                if (places > 8) {
                    all[i][random() % 3 + 5] = INFINITE;
                    all[i][8] = std::numeric_limits<float>::max();
                }
            }
            CAPTURE(quantum);
            CAPTURE(places);
            CHECK(count_different(all, quantum, 0) == 0);
            const Codes codes = codes_by_scalars(all[0], quantum);
            CHECK(codes[0] == SourceCode::NEAREST + 1);
            CHECK(codes[1] == SourceCode::NEAREST);
            CHECK(codes[2] == SourceCode::NEAREST + TableCode::LARGEST);
            CHECK(codes[3] == SourceCode::NEAREST + TableCode::LARGEST);
            CHECK(codes[4] == SourceCode::UNREACHED);
        }
}

TEST_CASE("rounding: vectors and StepsOf are at most one step apart, wherever the nearest place is") {
    std::mt19937 random(12);
    std::uniform_real_distribution<float> anywhere(1, 2000);
    std::vector<Distances> all(FIELDS_AT_ONCE, Distances(70));
    for (Distances& distances : all)
        for (float& distance : distances) distance = anywhere(random);
    CHECK(count_different(all, 0.37f, 1) == 0);
}

TEST_CASE("rounding: a quantum of 0, and one whose inverse is not finite") {
    std::vector<Distances> all(FIELDS_AT_ONCE, Distances(40, 1.f));
    for (Distances& distances : all) {
        distances[3] = 0;
        distances[7] = INFINITE;
        distances[9] = std::numeric_limits<float>::min();
    }
    const float smallest = std::numeric_limits<float>::denorm_min();
    for (const float quantum : {0.f, smallest}) {
        CAPTURE(quantum);
        CHECK(count_different(all, quantum, 0) == 0);
        const Codes codes = codes_by_scalars(all[0], quantum);
        CHECK(codes[0] == (quantum == 0 ? SourceCode::NEAREST : SourceCode::NEAREST + TableCode::LARGEST));
        CHECK(codes[3] == SourceCode::NEAREST);
        CHECK(codes[7] == SourceCode::UNREACHED);
    }
}
