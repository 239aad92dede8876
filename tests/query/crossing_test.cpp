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

// A border along a straight line in the plane, as seen from a source below it, and rows for points above.
struct FlatBorder {
    FlatBorder(size_t places, Point source, const std::vector<Point>& targets, std::mt19937& random) {
        std::uniform_real_distribution<double> gap(0.3, 1.7);
        std::vector<Point> border(places);
        for (size_t k = 1; k < places; ++k) border[k].x = border[k - 1].x + gap(random);
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
            const bool last = k + 1 == places;
            length[k] = last ? NAN : static_cast<float>(border[k + 1].x - border[k].x);
            half_inverse[k] = 0.5f / length[k];
            foot[k] = static_cast<float>(source.x - border[k].x);
            height[k] = static_cast<float>(-source.y);
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
