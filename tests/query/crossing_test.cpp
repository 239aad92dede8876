// The innermost loop of the overlay engine: by every instruction set that this processor has.
#include "src/overlay/kernels/dispatch.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include <doctest/doctest.h>

#include "tests/query/flat_border.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

struct Crossed {
    std::vector<float> distances;
    std::vector<uint16_t> winners;
};

// To targets with a row each, in which the places of the border lie side by side. Columns that are not wanted
// lie before, between and behind theirs.
Crossed cross(const Kernels& kernels, const BorderFromSource& border, Rows rows) {
    constexpr uint32_t FIRST = 3, APART = 2;
    std::vector<uint32_t> columns;
    for (uint32_t i = 0; i < rows.size(); ++i) columns.push_back(FIRST + APART * i);
    const size_t stride = SourceCode::whole_blocks(columns.back() + 1) + SourceCode::BLOCK;
    std::vector<uint16_t> table(border.places * stride, 1);
    std::vector<const uint16_t*> of_places;
    for (size_t k = 0; k < border.places; ++k) {
        for (size_t i = 0; i < rows.size(); ++i) table[k * stride + columns[i]] = rows[i][k];
        of_places.push_back(table.data() + k * stride);
    }
    Crossed crossed{std::vector<float>(rows.size()), std::vector<uint16_t>(rows.size())};
    kernels.cross(border, of_places, columns, crossed.distances.data(), crossed.winners.data());
    return crossed;
}

// A border as a kernel prepares it; its places are all their vertices' own.
struct PreparedBorder {
    PreparedBorder(const Kernels& kernels, const FlatBorder& flat, size_t places)
        : distance(flat.to_source), code(flat.code.size()), foot(code.size()), height(code.size()) {
        std::fill(distance.begin() + static_cast<std::ptrdiff_t>(places), distance.end(), INFINITE);
        border = flat.from_source();
        border.distance = distance.data();
        border.code = code.data();
        border.foot = foot.data();
        border.height = height.data();
        const std::vector<int8_t> is_own(code.size(), -1);
        range = kernels.prepare_crossing(border, is_own.data(), code.data(), foot.data(), height.data());
    }
    PreparedBorder(const PreparedBorder&) = delete;
    PreparedBorder& operator=(const PreparedBorder&) = delete;

    std::vector<float> distance;
    std::vector<int16_t> code;
    std::vector<float> foot, height;
    BorderFromSource border{};
    NearRange range{};
};

}

TEST_CASE("crossing: straight lines in the plane, by every instruction set") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> along(-5, 60), off(0.5, 30);
    for (size_t places : {5u, 7u, 15u, 16u, 17u, 31u, 33u, 48u, 63u, 100u, 129u, 150u, 300u})
        for (size_t targets : {1u, 3u, 64u, 131u}) {
            std::vector<Point> points;
            for (size_t i = 0; i < targets; ++i) points.push_back({along(random), off(random)});
            const Point source{along(random), -off(random)};
            const FlatBorder border(places, source, points, random);
            const BorderFromSource from_source = border.from_source();
            for (const Kernels& kernels : runnable_kernels()) {
                CAPTURE(kernels.name);
                CAPTURE(places);
                const Crossed crossed = cross(kernels, from_source, border.rows);
                uint64_t wrong = 0;
                for (size_t i = 0; i < targets; ++i) {
                    const Point& target = points[i];
                    const double x = source.x + (target.x - source.x) * source.y / (source.y - target.y);
                    const double line = distance(source, target);
                    const double rounding = 4 * double{border.quantum} + 1e-5 * line;
                    const double answer = double{crossed.distances[i]};
                    const bool straight = x > border.first_x && x < border.last_x;
                    wrong += straight ? std::abs(answer - line) > rounding : answer < line - rounding;
                }
                CHECK(wrong == 0);
            }
        }
}

// A hook: where straight lines cross a long segment, both of its ends are farther off than the tip.
TEST_CASE("crossing: near segments of a jagged border, by every instruction set") {
    const std::vector<Point> hook{{-34, 0}, {-24, 0}, {-14, 0}, {-4, 0},  {4, 0}, {5, 3},
                                  {4, 5},   {2, 5},   {1, 3.2}, {1.2, 4}, {2, 4}};
    std::mt19937 random(7);
    std::uniform_real_distribution<double> along(-1, 1), off(0.5, 1.5);
    uint64_t missed = 0;
    for (int repetition = 0; repetition < 20; ++repetition) {
        std::vector<Point> points;
        for (int i = 0; i < 70; ++i) points.push_back({along(random), off(random)});
        const Point source{along(random), -off(random)};
        const FlatBorder border(hook, source, points);
        std::vector<float> first;
        for (const Kernels& kernels : runnable_kernels()) {
            CAPTURE(kernels.name);
            const PreparedBorder prepared(kernels, border, hook.size());
            REQUIRE(prepared.range.is_near());
            CHECK(double{prepared.range.reach} == doctest::Approx(50.0));
            auto distances = cross(kernels, prepared.border, border.rows).distances;
            const auto before = distances;
            kernels.cross_near(prepared.border, prepared.range, border.rows, distances.data());
            uint64_t wrong = 0;
            for (size_t i = 0; i < points.size(); ++i) {
                const double line = test::distance(source, points[i]);
                wrong += std::abs(double{distances[i]} - line) > 4 * double{border.quantum};
                missed += double{before[i]} > 1.5 * line;
            }
            CHECK(wrong == 0);
            if (first.empty()) first = distances;
            CHECK(std::memcmp(first.data(), distances.data(), first.size() * sizeof(float)) == 0);
        }
    }
    CHECK(missed > 1000); // without cross_near()
}

TEST_CASE("crossing: near is what lies within five segments, and what is far stays as it is") {
    std::mt19937 random(8);
    const std::vector<Point> line = line_of(30, random);
    double longest = 0;
    for (size_t k = 0; k + 1 < line.size(); ++k) longest = std::max(longest, distance(line[k], line[k + 1]));
    const double reach = 5 * longest;
    for (const double share : {0.1, 0.6, 0.99, 1.01, 10.0}) {
        const Point source{line[14].x, -share * reach};
        const FlatBorder border(line, source, {{source.x, 2}, {source.x, 90}});
        for (const Kernels& kernels : runnable_kernels()) {
            CAPTURE(kernels.name);
            CAPTURE(share);
            const PreparedBorder prepared(kernels, border, line.size());
            CHECK(double{prepared.range.reach} == doctest::Approx(reach));
            REQUIRE(prepared.range.is_near() == (share < 1));
            if (!prepared.range.is_near()) continue;
            for (size_t k = 0; k < line.size(); ++k)
                CHECK((distance(source, line[k]) <= reach) ==
                      (k >= prepared.range.first && k <= prepared.range.last));
            std::vector<float> distances{prepared.range.reach, prepared.range.reach * 2};
            kernels.cross_near(prepared.border, prepared.range, border.rows, distances.data());
            CHECK(double{distances[0]} == doctest::Approx(share * reach + 2).epsilon(1e-3));
            CHECK(distances[1] == prepared.range.reach * 2);
        }
    }
}

TEST_CASE("crossing: the first place with the least sum wins, by every instruction set, and all give the "
          "same bits") {
    std::mt19937 random(2);
    for (size_t places : {5u, 16u, 40u, 64u, 65u, 128u, 200u})
        for (uint32_t largest : {3u, 0x7ffeu}) { // small numbers tie
            std::vector<Point> points(70, Point{0, 1});
            FlatBorder border(places, {1, -1}, points, random);
            for (uint16_t& code : border.codes) code = static_cast<uint16_t>(random() % (largest + 1));
            for (size_t k = 2; k + 2 < places; ++k)
                border.code[k] = static_cast<int16_t>(SourceCode::NEAREST +
                                                      static_cast<int32_t>(random() % (largest / 2 + 1)));
            border.code[2 + random() % (places - 4)] = SourceCode::NEAREST;
            const BorderFromSource from_source = border.from_source();
            Crossed first;
            for (const Kernels& kernels : runnable_kernels()) {
                CAPTURE(kernels.name);
                const Crossed crossed = cross(kernels, from_source, border.rows);
                for (size_t r = 0; r < border.rows.size(); ++r) {
                    size_t least = 2;
                    const auto sum = [&](size_t k) { return border.code[k] + border.rows[r][k]; };
                    for (size_t k = 2; k + 2 < places; ++k)
                        if (sum(k) < sum(least)) least = k;
                    CHECK(crossed.winners[r] == least);
                }
                if (first.distances.empty()) first = crossed;
                CHECK(std::memcmp(first.distances.data(), crossed.distances.data(),
                                  first.distances.size() * sizeof(float)) == 0);
            }
        }
}

TEST_CASE("crossing: ways of which one end is out of reach") {
    std::mt19937 random(3);
    const std::vector<Point> points(3, Point{5, 3});
    FlatBorder border(40, {5, -3}, points, random);
    for (size_t k = 0; k < 40; ++k) {
        border.codes[k] = TableCode::UNREACHED;                   // row 0: no place at all
        if (k != 30) border.codes[40 + k] = TableCode::UNREACHED; // row 1: one far off
    }
    border.codes[40 + 30] = 0x7ffe;
    const BorderFromSource from_source = border.from_source();
    for (const Kernels& kernels : runnable_kernels()) {
        CAPTURE(kernels.name);
        const Crossed crossed = cross(kernels, from_source, border.rows);
        CHECK(crossed.distances[0] == INFINITE);
        CHECK(crossed.winners[0] == BorderFromSource::NO_PLACE);
        CHECK(crossed.winners[1] == 30);
        CHECK(crossed.distances[1] <= border.to_source[30] + 0x7ffe * border.quantum);
        CHECK(double{crossed.distances[2]} == doctest::Approx(6).epsilon(1e-3));
    }
}

TEST_CASE("crossing: a border is made ready, by every instruction set") {
    std::mt19937 random(4);
    for (size_t places : {5u, 16u, 33u, 70u, 129u}) {
        const Point source{9, -4};
        FlatBorder border(places, source, {{3, 2}}, random);
        const size_t room = border.code.size();
        std::fill(border.to_source.begin() + static_cast<std::ptrdiff_t>(places), border.to_source.end(),
                  INFINITE);
        if (places > 30) border.to_source[20] = INFINITE;
        std::vector<int8_t> is_own(room, -1);
        is_own[0] = is_own[1] = is_own[places - 2] = is_own[places - 1] = 0;
        float nearest = INFINITE;
        for (size_t k = 0; k < places; ++k) nearest = std::min(nearest, border.to_source[k]);
        for (const Kernels& kernels : runnable_kernels()) {
            CAPTURE(kernels.name);
            CAPTURE(places);
            std::vector<int16_t> code(room, 77);
            std::vector<float> foot(room), height(room);
            const BorderFromSource from_source{places,
                                               code.data(),
                                               border.to_source.data(),
                                               border.length.data(),
                                               border.half_inverse.data(),
                                               foot.data(),
                                               height.data(),
                                               border.quantum};
            CHECK(
                kernels.prepare_crossing(from_source, is_own.data(), code.data(), foot.data(), height.data())
                    .nearest == nearest);
            uint64_t wrong = 0;
            for (size_t k = 0; k < (places + SourceCode::BLOCK - 1) / SourceCode::BLOCK * SourceCode::BLOCK;
                 ++k) {
                const bool is_reached = k < places && is_own[k] && border.to_source[k] < INFINITE;
                const double steps = (double{border.to_source[k]} - double{nearest}) / double{border.quantum};
                wrong += is_reached
                             ? std::abs(code[k] - SourceCode::NEAREST - std::min(steps, 32766.0)) > 0.51
                             : code[k] != SourceCode::UNREACHED;
            }
            for (size_t k = 0; k + 1 < places; ++k) {
                if (border.to_source[k] == INFINITE || border.to_source[k + 1] == INFINITE) continue;
                wrong += std::abs(foot[k] - border.foot[k]) > 1e-3f * border.to_source[k];
                wrong += std::abs(height[k] - border.height[k]) > 1e-3f * border.to_source[k];
            }
            CHECK(wrong == 0);
            const std::vector<float> nothing(room, INFINITE);
            BorderFromSource unreached = from_source;
            unreached.distance = nothing.data();
            CHECK(kernels.prepare_crossing(unreached, is_own.data(), code.data(), foot.data(), height.data())
                      .nearest == INFINITE);
        }
    }
}

namespace {

// One end below a border and one above it, with infinity behind the border.
struct FlatBorderBetween {
    FlatBorderBetween(const std::vector<Point>& line, Point from, Point to)
        : flat(line, from, {to}), to_target(flat.to_source.size(), INFINITE), places(line.size()) {
        for (size_t k = 0; k < places; ++k) to_target[k] = static_cast<float>(distance(line[k], to));
        std::fill(flat.to_source.begin() + static_cast<std::ptrdiff_t>(places), flat.to_source.end(),
                  INFINITE);
    }
    BorderBetween border() const {
        return {places, flat.to_source.data(), to_target.data(), flat.length.data(),
                flat.half_inverse.data()};
    }

    FlatBorder flat;
    std::vector<float> to_target;
    size_t places;
};

}

TEST_CASE(
    "crossing: two ends meet on a straight line or over an end of the border, by every instruction set") {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> along(-30, 90), off(0.1, 40);
    for (size_t places : {5u, 15u, 16u, 17u, 31u, 64u, 100u})
        for (int repetition = 0; repetition < 50; ++repetition) {
            const std::vector<Point> line = line_of(places, random);
            const Point from{along(random), -off(random)}, to{along(random), off(random)};
            const double crossing = from.x + (to.x - from.x) * from.y / (from.y - to.y);
            const Point over{std::clamp(crossing, 0.0, line.back().x), 0};
            const double expected = distance(from, over) + distance(over, to);
            const FlatBorderBetween between(line, from, to);
            const float first = runnable_kernels().front().meet(between.border());
            CHECK(double{first} == doctest::Approx(expected).epsilon(1e-4));
            for (const Kernels& kernels : runnable_kernels()) CHECK(kernels.meet(between.border()) == first);
        }
}

TEST_CASE("crossing: two ends meet only where both reach the border") {
    std::mt19937 random(10);
    const std::vector<Point> line = line_of(40, random);
    FlatBorderBetween between(line, {9, -4}, {12, 3});
    std::fill_n(between.flat.to_source.begin() + 20, 20, INFINITE);
    std::fill_n(between.to_target.begin(), 19, INFINITE);
    for (const Kernels& kernels : runnable_kernels()) {
        CAPTURE(kernels.name);
        CHECK(double{kernels.meet(between.border())} ==
              doctest::Approx(distance({9, -4}, line[19]) + distance(line[19], {12, 3})));
    }
    between.to_target[19] = INFINITE;
    for (const Kernels& kernels : runnable_kernels()) CHECK(kernels.meet(between.border()) == INFINITE);
}

namespace {

// To the targets of a border, by columns side by side.
Crossed cross_few(const Kernels& kernels, const FlatBorder& flat, size_t places,
                  const std::vector<int8_t>& is_own) {
    const size_t targets = flat.rows.size(), stride = SourceCode::whole_blocks(targets) + SourceCode::BLOCK;
    std::vector<uint16_t> table(places * stride, 1);
    std::vector<const uint16_t*> rows;
    for (size_t k = 0; k < places; ++k) {
        for (size_t i = 0; i < targets; ++i) table[k * stride + i] = flat.rows[i][k];
        rows.push_back(table.data() + k * stride);
    }
    const FewPlaces few{places,        flat.to_source.data(), flat.length.data(), flat.half_inverse.data(),
                        is_own.data(), flat.quantum};
    Crossed crossed{std::vector<float>(stride), std::vector<uint16_t>(stride)};
    for (size_t first = 0; first < targets; first += Kernels::FEW_COLUMNS)
        kernels.cross_few(few, rows, first, std::min(Kernels::FEW_COLUMNS, targets - first),
                          crossed.distances.data() + first, crossed.winners.data() + first);
    crossed.distances.resize(targets);
    crossed.winners.resize(targets);
    return crossed;
}

// The first of the own places with the least sum, by plain sums.
size_t place_of_least_sum(const FlatBorder& flat, size_t places, const std::vector<int8_t>& is_own,
                          size_t target) {
    size_t winner = BorderFromSource::NO_PLACE;
    float least = INFINITE;
    for (size_t k = 0; k < places; ++k) {
        const float sum = flat.to_source[k] + TableCode::distance(flat.rows[target][k], flat.quantum);
        if (!is_own[k] || sum >= least) continue;
        least = sum;
        winner = k;
    }
    return winner;
}

}

// As over near segments, but the straight way is found at once, however far it is.
TEST_CASE("crossing: over few places straight ways cross any segment, by every instruction set") {
    std::mt19937 random(13);
    for (const size_t places : {3u, 11u, 16u, 17u, 31u, 32u})
        for (const double off : {0.7, 40.0}) {
            CAPTURE(places);
            CAPTURE(off);
            std::vector<Point> line = line_of(places, random);
            for (size_t k = 1; k + 1 < places; k += 2) line[k].y = -0.2;
            std::uniform_real_distribution<double> along(line[1].x, line[places - 2].x);
            std::vector<Point> points;
            for (int i = 0; i < 45; ++i) points.push_back({along(random), off});
            const Point source{along(random), -off};
            const FlatBorder border(line, source, points);
            std::vector<int8_t> is_own(border.code.size(), -1);
            is_own[0] = is_own[places - 1] = 0;
            Crossed first;
            for (const Kernels& kernels : runnable_kernels()) {
                CAPTURE(kernels.name);
                const Crossed crossed = cross_few(kernels, border, places, is_own);
                for (size_t i = 0; i < points.size(); ++i) {
                    CHECK(double{crossed.distances[i]} ==
                          doctest::Approx(distance(source, points[i])).epsilon(1e-3));
                    CHECK(crossed.winners[i] == place_of_least_sum(border, places, is_own, i));
                }
                if (first.distances.empty()) first = crossed;
                CHECK(std::memcmp(first.distances.data(), crossed.distances.data(),
                                  first.distances.size() * sizeof(float)) == 0);
            }
        }
}

TEST_CASE(
    "crossing: over few places there is a way only where both ends reach one that is the border's own") {
    std::mt19937 random(14);
    const std::vector<Point> points(3, Point{5, 3});
    FlatBorder border(20, {5, -3}, points, random);
    for (size_t k = 0; k < 20; ++k) {
        border.codes[k] = TableCode::UNREACHED;                   // row 0: no place at all
        if (k != 15) border.codes[20 + k] = TableCode::UNREACHED; // row 1: one far off
        if (k != 18) border.codes[40 + k] = TableCode::UNREACHED; // row 2: one that repeats another
    }
    std::vector<int8_t> is_own(border.code.size(), -1);
    is_own[18] = 0;
    for (const Kernels& kernels : runnable_kernels()) {
        CAPTURE(kernels.name);
        const Crossed crossed = cross_few(kernels, border, 20, is_own);
        CHECK(crossed.distances[0] == INFINITE);
        CHECK(crossed.winners[0] == BorderFromSource::NO_PLACE);
        CHECK(crossed.distances[1] ==
              border.to_source[15] + TableCode::distance(border.rows[1][15], border.quantum));
        CHECK(crossed.winners[1] == 15);
        CHECK(crossed.distances[2] == INFINITE);
        CHECK(crossed.winners[2] == BorderFromSource::NO_PLACE);
    }
}

// Where only the ends of a segment repeat places, it is crossed, and no own place wins.
TEST_CASE("crossing: over few places, segments between repeated places are crossed") {
    std::mt19937 random(15);
    FlatBorder border(20, {5, -3}, {{5, 3}}, random);
    const std::vector<int8_t> is_own(border.code.size(), 0);
    for (const Kernels& kernels : runnable_kernels()) {
        CAPTURE(kernels.name);
        const Crossed crossed = cross_few(kernels, border, 20, is_own);
        CHECK(double{crossed.distances[0]} == doctest::Approx(6).epsilon(1e-3));
        CHECK(crossed.winners[0] == BorderFromSource::NO_PLACE);
    }
}

// By plain sums, in steps: the least one, and the first sample that has it.
TEST_CASE("crossing: over samples it takes the least sum, with every instruction set") {
    std::mt19937 random(11);
    const float quantum = 0.25f;
    for (const size_t samples : {1u, 2u, 31u, 32u, 33u, 70u})
        for (const size_t columns : {1u, 15u, 32u, 33u, 70u, 100u}) {
            CAPTURE(samples);
            CAPTURE(columns);
            std::vector<float> distance(SourceCode::whole_blocks(samples), INFINITE);
            std::vector<uint16_t> table(samples * columns + SourceCode::BLOCK);
            const TableRows rows{table.data(), columns, samples};
            for (size_t i = 0; i < samples; ++i)
                if (random() % 8 != 0 || i == 0)
                    distance[i] = 1000.f + quantum * static_cast<float>(i ? random() % 2000 : 0);
            for (uint16_t& code : table)
                code = random() % 16 == 0 ? TableCode::UNREACHED : static_cast<uint16_t>(random() % 3000);
            for (const Kernels& kernels : runnable_kernels()) {
                CAPTURE(kernels.name);
                std::vector<int16_t> scratch(distance.size());
                std::vector<float> found(SourceCode::whole_blocks(columns));
                std::vector<uint16_t> winners(found.size());
                kernels.cross_samples({distance.data(), quantum, {}, scratch.data()}, rows, found.data(),
                                      winners.data());
                for (size_t c = 0; c < columns; ++c) {
                    float least = INFINITE;
                    size_t winner = 0;
                    for (size_t i = 0; i < samples; ++i) {
                        const float sum = distance[i] + TableCode::distance(rows[i][c], quantum);
                        if (sum >= least) continue;
                        least = sum;
                        winner = i;
                    }
                    CHECK(found[c] == least);
                    if (least < INFINITE) CHECK(winners[c] == winner);
                }
            }
        }
}

TEST_CASE("crossing: over samples that are not reached there is no way") {
    const std::vector<float> distance(SourceCode::BLOCK, INFINITE);
    const std::vector<uint16_t> table(2 * SourceCode::BLOCK, 5);
    const TableRows rows{table.data(), 20, 2};
    for (const Kernels& kernels : runnable_kernels()) {
        std::vector<int16_t> scratch(SourceCode::BLOCK);
        std::vector<float> found(SourceCode::BLOCK, 0);
        std::vector<uint16_t> winners(SourceCode::BLOCK);
        kernels.cross_samples({distance.data(), 1, {}, scratch.data()}, rows, found.data(), winners.data());
        CHECK(std::ranges::all_of(found, [](float d) { return d == INFINITE; }));
    }
}
