// Windows by themselves: which of two is lower where.
#include "src/metric/window.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "tests/metric/windows.h"

using namespace geodesic;
using geodesic::test::random_window;
using geodesic::test::uniform;
using geodesic::test::window_over;

TEST_CASE("windows: where a challenger wins it is lower, and elsewhere it is not") {
    std::mt19937_64 random(1);
    size_t wrong = 0, won_somewhere = 0, inside_out = 0;
    for (uint32_t i = 0; i < 20000; ++i) {
        const Window a = random_window(random, 0), b = random_window(random, 1);
        const double s = std::max(a.begin, b.begin), t = std::min(a.end, b.end);
        if (!(s < t)) continue;
        const Advantage won = advantage(a, b, s, t);
        won_somewhere += won.begin < won.end;
        inside_out += won.inside_out;
        for (int k = 0; k < 40; ++k) {
            const double at = s + (t - s) * (k + 0.5) / 40;
            const bool inside = at > won.begin && at < won.end;
            const bool lower = won.inside_out ? !inside : inside;
            const double difference = a.distance_at(at) - b.distance_at(at);
            if (std::abs(difference) > 1e-9) wrong += (difference < 0) != lower;
        }
    }
    CHECK(wrong == 0);
    CHECK(won_somewhere > 1000);
    CHECK(inside_out > 100);
}

TEST_CASE("windows: two that touch at an end, one source behind the other") {
    // Behind a vertex that bends paths its window and the one of the source before it have the same distance
    // and slope at the end of the light; there the sign of their difference is rounding.
    std::mt19937_64 random(6);
    size_t wrong = 0;
    for (int i = 0; i < 20000; ++i) {
        const double s = uniform(random, 0, 1), t = s + uniform(random, 1e-3, 0.5);
        const bool mirrored = random() & 1; // they touch at t
        const double touch = mirrored ? t : s;
        const double x = uniform(random, -1, 2), y = uniform(random, 0.01, 1),
                     share = uniform(random, 0.05, 0.95);
        const Window far = window_over(s, t, x, y, uniform(random, 0, 1), 0);
        const double near_x = x + share * (touch - x), near_y = y * (1 - share);
        const double between = std::sqrt((near_x - x) * (near_x - x) + (near_y - y) * (near_y - y));
        Window near = window_over(s, t, near_x, near_y, far.sigma + between, 1);
        for (double* end : {&near.begin_distance, &near.end_distance})
            for (uint64_t k = random() % 3; k > 0; --k) *end = std::nextafter(*end, random() & 1 ? 9 : -9);
        // Straight from the far source is shorter everywhere.
        for (const bool far_challenges : {true, false}) {
            const Window &challenger = far_challenges ? far : near, &holder = far_challenges ? near : far;
            const Advantage won = advantage(challenger, holder, s, t);
            for (int k = 0; k < 20; ++k) {
                const double at = s + (t - s) * (k + 0.5) / 20;
                const bool inside = at > won.begin && at < won.end;
                const double difference = challenger.distance_at(at) - holder.distance_at(at);
                if (std::abs(difference) > 1e-9)
                    wrong += (difference < 0) != (won.inside_out ? !inside : inside);
            }
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("windows: of two equal ones the holder stays") {
    std::mt19937_64 random(2);
    for (int i = 0; i < 200; ++i) {
        const Window a = random_window(random, 0);
        if (!(a.begin < a.end)) continue;
        const Advantage won = advantage(a, a, a.begin, a.end);
        CHECK(!won.inside_out);
        CHECK(won.begin >= won.end);
    }
}
