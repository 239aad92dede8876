// Windows by themselves: which of two is lower where, and the lower envelope of many.
#include "src/metric/window.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "src/metric/window_lists.h"
#include "tests/support/meshes.h"

using namespace geodesic;
using geodesic::test::uniform;

namespace {

Window window_over(double begin, double end, double x, double y, double sigma, uint32_t nearest) {
    Window window{begin, end, x, y, sigma, 0, 0, nearest, nearest & MAX_NEAREST, 1};
    window.begin_distance = window.distance_at(begin);
    window.end_distance = window.distance_at(end);
    return window;
}

Window random_window(std::mt19937_64& random, uint32_t nearest) {
    double begin = uniform(random, 0, 1), end = uniform(random, 0, 1);
    if (random() % 3 == 0) begin = 0;
    if (random() % 3 == 0) end = 1;
    if (begin > end) std::swap(begin, end);
    // Sources on the edge's own line and equal offsets are among them.
    const double y = random() % 5 == 0 ? 0 : uniform(random, 0, 1);
    const double sigma = random() % 2 == 0 ? 0 : uniform(random, 0, 0.5);
    return window_over(begin, end, uniform(random, -0.5, 1.5), y, sigma, nearest);
}

}

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

TEST_CASE("window lists: the lower envelope, sorted and without overlaps") {
    std::mt19937_64 random(3);
    WindowLists lists(3);
    for (int round = 0; round < 60; ++round) {
        lists.clear();
        CHECK(lists.at(1).empty());
        std::vector<Window> inserted;
        const uint32_t count = 1 + static_cast<uint32_t>(random() % 40);
        for (uint32_t i = 0; i < count; ++i) {
            Window window = random_window(random, i);
            if (!(window.end - window.begin > 1e-6)) continue;
            // Interleaved with other edges, whose blocks move in the same pool.
            const uint32_t edge = static_cast<uint32_t>(random() % 3);
            if (edge == 1) inserted.push_back(window);
            lists.insert(edge, window);
        }
        const auto list = lists.at(1);
        for (size_t i = 0; i < list.size(); ++i) {
            CHECK(list[i].begin < list[i].end);
            if (i > 0) CHECK(list[i - 1].end <= list[i].begin);
            CHECK(list[i].begin_distance ==
                  doctest::Approx(list[i].distance_at(list[i].begin)).epsilon(1e-12));
            CHECK(list[i].end_distance == doctest::Approx(list[i].distance_at(list[i].end)).epsilon(1e-12));
        }
        size_t wrong = 0;
        for (int k = 0; k < 500; ++k) {
            const double t = uniform(random, 0, 1);
            double expected = HUGE_VAL, found = HUGE_VAL;
            for (const Window& w : inserted)
                if (w.begin <= t && t <= w.end) expected = std::min(expected, w.distance_at(t));
            for (const Window& w : list)
                if (w.begin <= t && t <= w.end) found = std::min(found, w.distance_at(t));
            if (expected != found) wrong += !(std::abs(expected - found) < 1e-9);
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("window lists: insert tells the smallest distance that the window has won") {
    std::mt19937_64 random(4);
    for (int round = 0; round < 300; ++round) {
        WindowLists lists(1);
        const Window holder = random_window(random, 0), window = random_window(random, 1);
        if (!(holder.begin < holder.end) || !(window.begin < window.end)) continue;
        lists.insert(0, holder);
        const double told = lists.insert(0, window);
        double smallest = HUGE_VAL;
        for (const Window& part : lists.at(0)) {
            if (part.nearest != 1) continue;
            for (int k = 0; k <= 200; ++k)
                smallest =
                    std::min(smallest, part.distance_at(part.begin + (part.end - part.begin) * k / 200));
        }
        if (smallest == HUGE_VAL) {
            CHECK(told == HUGE_VAL);
            continue;
        }
        CHECK(told <= smallest + 1e-12);
        CHECK(told > smallest - 0.02); // between two samples it may dip a little
    }
}
