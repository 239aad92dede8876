// The innermost loop of the overlay engine: every kernel that this processor can run.
#include "src/query/crossing.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "src/index/overlay_tables.h"

using namespace geodesic;

namespace {

constexpr float INFINITE = std::numeric_limits<float>::infinity();

struct Point {
    double x, y;
};

double distance(Point a, Point b) { return std::hypot(a.x - b.x, a.y - b.y); }

// Along a straight line.
std::vector<Point> line_of(size_t places, std::mt19937& random) {
    std::uniform_real_distribution<double> gap(0.3, 1.7);
    std::vector<Point> border(places);
    for (size_t k = 1; k < places; ++k) border[k].x = border[k - 1].x + gap(random);
    return border;
}

// A border in the plane, as seen from a source below it, and rows for points above.
struct FlatBorder {
    FlatBorder(size_t places, Point source, const std::vector<Point>& targets, std::mt19937& random)
        : FlatBorder(line_of(places, random), source, targets) {}

    FlatBorder(const std::vector<Point>& border, Point source, const std::vector<Point>& targets) {
        const size_t places = border.size();
        double longest = 0;
        for (const Point& target : targets)
            for (const Point& at : border) longest = std::max(longest, geodesic_distance(target, at));
        quantum = static_cast<float>(longest / OverlayTables::LARGEST);
        const size_t room = (places / SeenBorder::BLOCK + 2) * SeenBorder::BLOCK;
        code.assign(room, SeenBorder::NOT_SEEN);
        for (auto* values : {&to_source, &length, &half_inverse, &foot, &height}) values->assign(room, 0);
        double nearest = longest;
        for (const Point& at : border) nearest = std::min(nearest, geodesic_distance(source, at));
        for (size_t k = 0; k < places; ++k) {
            to_source[k] = static_cast<float>(geodesic_distance(source, border[k]));
            code[k] = static_cast<int16_t>(
                SeenBorder::NEAREST +
                std::lround(std::min((double{to_source[k]} - nearest) / double{quantum}, 32766.0)));
            const Point next = border[std::min(k + 1, places - 1)];
            const Point along{next.x - border[k].x, next.y - border[k].y};
            const Point seen{source.x - border[k].x, source.y - border[k].y};
            length[k] = k + 1 == places ? NAN : static_cast<float>(std::hypot(along.x, along.y));
            half_inverse[k] = 0.5f / length[k];
            foot[k] = static_cast<float>((seen.x * along.x + seen.y * along.y) / double{length[k]});
            height[k] = static_cast<float>(std::abs(seen.x * along.y - seen.y * along.x) / double{length[k]});
        }
        // The ends are there to be neighbours only.
        for (size_t k : {size_t{0}, size_t{1}, places - 2, places - 1}) code[k] = SeenBorder::NOT_SEEN;
        codes.assign(targets.size() * places + SeenBorder::BLOCK, 0);
        for (size_t r = 0; r < targets.size(); ++r)
            for (size_t k = 0; k < places; ++k)
                codes[r * places + k] = static_cast<uint16_t>(
                    std::lround(geodesic_distance(targets[r], border[k]) / double{quantum}));
        for (size_t r = 0; r < targets.size(); ++r) rows.push_back(codes.data() + r * places);
        first_x = border[2].x;
        last_x = border[places - 3].x;
    }
    static double geodesic_distance(Point a, Point b) { return ::distance(a, b); }

    SeenBorder seen() const {
        return {rows.size() > 1 ? static_cast<size_t>(rows[1] - rows[0]) : codes.size() - SeenBorder::BLOCK,
                code.data(),
                to_source.data(),
                length.data(),
                half_inverse.data(),
                foot.data(),
                height.data(),
                quantum};
    }

    float quantum;
    std::vector<int16_t> code;
    std::vector<float> to_source, length, half_inverse, foot, height;
    std::vector<uint16_t> codes;
    std::vector<const uint16_t*> rows;
    double first_x, last_x; // of what may be crossed
};

struct Crossed {
    std::vector<float> distances;
    std::vector<uint16_t> winners;
};

Crossed cross(const CrossingKernel& kernel, const SeenBorder& border, Rows rows) {
    Crossed crossed{std::vector<float>(rows.size()), std::vector<uint16_t>(rows.size())};
    kernel.cross(border, rows, crossed.distances.data(), crossed.winners.data());
    return crossed;
}

}

TEST_CASE("crossing: straight lines in the plane, by every kernel") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> along(-5, 60), off(0.5, 30);
    for (size_t places : {5u, 7u, 15u, 16u, 17u, 31u, 33u, 48u, 63u, 100u, 129u, 150u, 300u})
        for (size_t targets : {1u, 3u, 64u, 131u}) {
            std::vector<Point> points;
            for (size_t i = 0; i < targets; ++i) points.push_back({along(random), off(random)});
            const Point source{along(random), -off(random)};
            const FlatBorder border(places, source, points, random);
            const SeenBorder seen = border.seen();
            for (const CrossingKernel& kernel : crossing_kernels()) {
                CAPTURE(kernel.name);
                CAPTURE(places);
                const Crossed crossed = cross(kernel, seen, border.rows);
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
TEST_CASE("crossing: near segments of a jagged border, by every kernel") {
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
        const SeenBorder seen = border.seen();
        const std::vector<int32_t> is_own(border.code.size(), -1);
        std::vector<float> first;
        for (const CrossingKernel& kernel : crossing_kernels()) {
            CAPTURE(kernel.name);
            std::vector<int16_t> code(border.code.size());
            std::vector<float> foot(code.size()), height(code.size());
            auto distance = border.to_source;
            std::fill(distance.begin() + static_cast<std::ptrdiff_t>(hook.size()), distance.end(), INFINITE);
            SeenBorder near = seen;
            near.distance = distance.data();
            near.code = code.data();
            near.foot = foot.data();
            near.height = height.data();
            const Sight sight = kernel.see(near, is_own.data(), code.data(), foot.data(), height.data());
            REQUIRE(sight.is_near());
            CHECK(double{sight.reach} == doctest::Approx(double{OverlayTables::NEAR} * 10));
            auto distances = cross(kernel, near, border.rows).distances;
            const auto before = distances;
            kernel.lower_near(near, sight, border.rows, distances.data());
            uint64_t wrong = 0;
            for (size_t i = 0; i < points.size(); ++i) {
                const double line = ::distance(source, points[i]);
                wrong += std::abs(double{distances[i]} - line) > 4 * double{border.quantum};
                missed += double{before[i]} > 1.5 * line;
            }
            CHECK(wrong == 0);
            if (first.empty()) first = distances;
            CHECK(std::memcmp(first.data(), distances.data(), first.size() * sizeof(float)) == 0);
        }
    }
    CHECK(missed > 1000); // without lower_near()
}

TEST_CASE("crossing: what is far stays as it is") {
    std::mt19937 random(8);
    const std::vector<Point> points{{9, 2}, {9, 90}};
    for (const Point source : {Point{9, -2}, Point{9, -90}}) {
        const FlatBorder border(30, source, points, random);
        const SeenBorder seen = border.seen();
        for (const CrossingKernel& kernel : crossing_kernels()) {
            CAPTURE(kernel.name);
            const float longest = *std::max_element(border.length.begin(), border.length.begin() + 29);
            const float reach = OverlayTables::NEAR * longest;
            const bool is_near = -source.y < double{reach};
            const Sight sight{0, reach, is_near ? size_t{0} : size_t{1}, is_near ? size_t{29} : size_t{0}};
            std::vector<float> distances{reach, reach * 2};
            if (sight.is_near()) kernel.lower_near(seen, sight, border.rows, distances.data());
            CHECK(double{distances[0]} == doctest::Approx(is_near ? 4 : double{reach}).epsilon(1e-3));
            CHECK(distances[1] == reach * 2);
        }
    }
}

TEST_CASE("crossing: the first place with the least sum wins, by every kernel, and all give the same bits") {
    std::mt19937 random(2);
    for (size_t places : {5u, 16u, 40u, 64u, 65u, 128u, 200u})
        for (uint32_t largest : {3u, 0x7ffeu}) { // small numbers tie
            std::vector<Point> points(70, Point{0, 1});
            FlatBorder border(places, {1, -1}, points, random);
            for (uint16_t& code : border.codes) code = static_cast<uint16_t>(random() % (largest + 1));
            for (size_t k = 2; k + 2 < places; ++k)
                border.code[k] = static_cast<int16_t>(SeenBorder::NEAREST + random() % (largest / 2 + 1));
            border.code[2 + random() % (places - 4)] = SeenBorder::NEAREST;
            const SeenBorder seen = border.seen();
            Crossed first;
            for (const CrossingKernel& kernel : crossing_kernels()) {
                CAPTURE(kernel.name);
                const Crossed crossed = cross(kernel, seen, border.rows);
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
        border.codes[k] = OverlayTables::UNREACHED;                   // row 0: no place at all
        if (k != 30) border.codes[40 + k] = OverlayTables::UNREACHED; // row 1: one far off
    }
    border.codes[40 + 30] = 0x7ffe;
    const SeenBorder seen = border.seen();
    for (const CrossingKernel& kernel : crossing_kernels()) {
        CAPTURE(kernel.name);
        const Crossed crossed = cross(kernel, seen, border.rows);
        CHECK(crossed.distances[0] == INFINITE);
        CHECK(crossed.winners[0] == SeenBorder::NO_PLACE);
        CHECK(crossed.winners[1] == 30);
        CHECK(crossed.distances[1] <= border.to_source[30] + 0x7ffe * border.quantum);
        CHECK(double{crossed.distances[2]} == doctest::Approx(6).epsilon(1e-3));
    }
}

TEST_CASE("crossing: what is seen of a border, by every kernel") {
    std::mt19937 random(4);
    for (size_t places : {5u, 16u, 33u, 70u, 129u}) {
        const Point source{9, -4};
        FlatBorder border(places, source, {{3, 2}}, random);
        const size_t room = border.code.size();
        std::fill(border.to_source.begin() + static_cast<std::ptrdiff_t>(places), border.to_source.end(),
                  INFINITE);
        if (places > 30) border.to_source[20] = INFINITE;
        std::vector<int32_t> is_own(room, -1);
        is_own[0] = is_own[1] = is_own[places - 2] = is_own[places - 1] = 0;
        float nearest = INFINITE;
        for (size_t k = 0; k < places; ++k) nearest = std::min(nearest, border.to_source[k]);
        for (const CrossingKernel& kernel : crossing_kernels()) {
            CAPTURE(kernel.name);
            CAPTURE(places);
            std::vector<int16_t> code(room, 77);
            std::vector<float> foot(room), height(room);
            const SeenBorder seen{places,
                                  code.data(),
                                  border.to_source.data(),
                                  border.length.data(),
                                  border.half_inverse.data(),
                                  foot.data(),
                                  height.data(),
                                  border.quantum};
            CHECK(kernel.see(seen, is_own.data(), code.data(), foot.data(), height.data()).nearest ==
                  nearest);
            uint64_t wrong = 0;
            for (size_t k = 0; k < (places + SeenBorder::BLOCK - 1) / SeenBorder::BLOCK * SeenBorder::BLOCK;
                 ++k) {
                const bool is_seen = k < places && is_own[k] && border.to_source[k] < INFINITE;
                const double steps = (double{border.to_source[k]} - double{nearest}) / double{border.quantum};
                wrong += is_seen ? std::abs(code[k] - SeenBorder::NEAREST - std::min(steps, 32766.0)) > 0.51
                                 : code[k] != SeenBorder::NOT_SEEN;
            }
            for (size_t k = 0; k + 1 < places; ++k) {
                if (border.to_source[k] == INFINITE || border.to_source[k + 1] == INFINITE) continue;
                wrong += std::abs(foot[k] - border.foot[k]) > 1e-3f * border.to_source[k];
                wrong += std::abs(height[k] - border.height[k]) > 1e-3f * border.to_source[k];
            }
            CHECK(wrong == 0);
            const std::vector<float> nothing(room, INFINITE);
            SeenBorder unseen = seen;
            unseen.distance = nothing.data();
            CHECK(kernel.see(unseen, is_own.data(), code.data(), foot.data(), height.data()).nearest ==
                  INFINITE);
        }
    }
}

TEST_CASE("crossing: from each of several sources as from each alone, by every kernel") {
    constexpr size_t SOURCES = SeenBorders::SOURCES;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> along(-5, 60), off(0.5, 30);
    for (size_t places : {5u, 17u, 48u, 130u})
        for (size_t targets : {1u, 4u, 7u, 70u}) {
            std::vector<Point> points;
            for (size_t i = 0; i < targets; ++i) points.push_back({along(random), off(random)});
            std::vector<FlatBorder> borders;
            for (size_t i = 0; i < SOURCES; ++i) {
                auto same = std::mt19937(6); // the same border from another source
                borders.emplace_back(places, Point{along(random), -off(random)}, points, same);
            }
            if (places > 40) // a row that nothing is seen over, but from one source
                for (size_t k = 0; k < places; ++k)
                    if (k != 30) borders[0].codes[k] = OverlayTables::UNREACHED;
            borders[3].code[30 % places] = SeenBorder::NOT_SEEN;
            const size_t stride = borders[0].foot.size();
            std::vector<float> distance, foot, height;
            std::vector<int16_t> code(stride * SOURCES);
            for (size_t i = 0; i < SOURCES; ++i) {
                borders[i].quantum = borders[0].quantum;
                distance.insert(distance.end(), borders[i].to_source.begin(), borders[i].to_source.end());
                foot.insert(foot.end(), borders[i].foot.begin(), borders[i].foot.end());
                height.insert(height.end(), borders[i].height.begin(), borders[i].height.end());
                for (size_t k = 0; k < places; ++k) code[k * SOURCES + i] = borders[i].code[k];
            }
            SeenBorder first = borders[0].seen();
            first.distance = distance.data();
            first.foot = foot.data();
            first.height = height.data();
            first.places = places;
            for (const CrossingKernel& kernel : crossing_kernels()) {
                CAPTURE(kernel.name);
                std::vector<float> each(targets * SOURCES);
                kernel.cross_each({first, stride, code.data()}, borders[0].rows, each.data());
                uint64_t wrong = 0;
                for (size_t i = 0; i < SOURCES; ++i) {
                    SeenBorder alone = borders[i].seen();
                    alone.places = places;
                    const Crossed crossed = cross(kernel, alone, borders[0].rows);
                    for (size_t r = 0; r < targets; ++r)
                        wrong +=
                            std::memcmp(&crossed.distances[r], &each[r * SOURCES + i], sizeof(float)) != 0;
                }
                CHECK(wrong == 0);
            }
        }
}
