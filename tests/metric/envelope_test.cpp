// The lower envelope of windows on one edge, and the lists that keep one for every edge.
#include "src/metric/envelope.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "src/metric/window_lists.h"
#include "tests/metric/windows.h"

using namespace geodesic;
using geodesic::test::random_window;
using geodesic::test::uniform;

namespace {

// By paths over a window, and then along the edge.
double lowest_at(std::span<const Window> windows, double t) {
    double lowest = HUGE_VAL;
    for (const Window& w : windows) {
        const double crossing = std::clamp(t, w.begin, w.end);
        lowest = std::min(lowest, w.distance_at(crossing) + std::abs(t - crossing));
    }
    return lowest;
}

std::vector<Window> random_windows(std::mt19937_64& random, uint32_t count) {
    std::vector<Window> windows;
    for (uint32_t i = 0; i < count; ++i) {
        const Window window = random_window(random, i);
        if (window.end - window.begin > 1e-6) windows.push_back(window);
    }
    return windows;
}

// Lit from a source that is 1 off the edge, beside its point x.
Window window_below(double x, double begin, double end, double sigma, uint32_t nearest) {
    Window window{begin, end, x, 1, sigma, 0, 0, 0, nearest & MAX_NEAREST, 1};
    window.begin_distance = window.distance_at(begin);
    window.end_distance = window.distance_at(end);
    return window;
}

void check_is_envelope(std::span<const Window> list, std::span<const Window> inserted,
                       std::mt19937_64& random) {
    size_t disordered = 0, wrong = 0;
    for (size_t i = 0; i < list.size(); ++i) {
        disordered += !(list[i].begin < list[i].end);
        disordered += i > 0 && !(list[i - 1].end <= list[i].begin);
        wrong += !(std::abs(list[i].begin_distance - list[i].distance_at(list[i].begin)) < 1e-12);
        wrong += !(std::abs(list[i].end_distance - list[i].distance_at(list[i].end)) < 1e-12);
    }
    for (int k = 0; k < 500; ++k) {
        const double t = uniform(random, 0, 1);
        const double expected = lowest_at(inserted, t), found = lowest_at(list, t);
        if (expected != found) wrong += !(std::abs(expected - found) < 1e-9);
    }
    CHECK(disordered == 0);
    CHECK(wrong == 0);
}

}

TEST_CASE("envelope: of many windows, in any order") {
    std::mt19937_64 random(3);
    Envelope envelope;
    for (int round = 0; round < 100; ++round) {
        auto windows = random_windows(random, 1 + static_cast<uint32_t>(random() % 40));
        if (round % 3 == 1) std::ranges::sort(windows, {}, &Window::begin);
        if (round % 3 == 2) std::ranges::sort(windows, std::greater<>{}, &Window::end);
        auto scratch = windows;
        check_is_envelope(envelope.merge({}, scratch), windows, random);
    }
}

TEST_CASE("envelope: a run of windows put into a list that is there") {
    std::mt19937_64 random(5);
    Envelope envelope;
    for (int round = 0; round < 100; ++round) {
        auto windows = random_windows(random, static_cast<uint32_t>(random() % 20));
        auto scratch = windows;
        const auto first = envelope.merge({}, scratch);
        const std::vector<Window> holders(first.begin(), first.end());

        auto run = random_windows(random, static_cast<uint32_t>(random() % 20));
        windows.insert(windows.end(), run.begin(), run.end());
        check_is_envelope(envelope.merge(holders, run), windows, random);
    }
}

TEST_CASE("envelope: what is beaten by a way along the edge does not stay in gaps") {
    const auto window = [](double begin, double end, double sigma, uint32_t nearest) {
        return window_below(0.5, begin, end, sigma, nearest);
    };
    const std::vector<Window> near{window(0.1, 0.4, 0, 0), window(0.4 + 1e-9, 0.8, 0, 0)};
    const auto count_far = [](std::span<const Window> list) {
        return std::ranges::count_if(list, [](const Window& w) { return w.nearest == 1; });
    };
    Envelope envelope;
    auto far = window(0, 1, 0.3, 1);
    const auto filled = envelope.merge(near, {&far, 1});
    CHECK(count_far(filled) == 0); // at both ends of the edge, too
    CHECK(filled.size() == 2);
    CHECK(envelope.lowest() == HUGE_VAL);

    // Those that are there already are taken away.
    const std::vector<Window> holders{window(0.39, 0.41, 0.3, 1)};
    auto later = near;
    CHECK(count_far(envelope.merge(holders, later)) == 0);

    // What may still be shorter farther away stays.
    auto beyond = window(0, 1, 0.05, 1);
    CHECK(count_far(envelope.merge(near, {&beyond, 1})) == 2);
}

TEST_CASE("envelope: windows that see one source and lie end to end are joined, whatever was rounded") {
    constexpr double ULP = 1e-16;
    Envelope envelope;
    std::vector<Window> run{window_below(0.3, 0.1, 0.4, 0, 0), window_below(0.3 + ULP, 0.4 + ULP, 0.7, 0, 0),
                            window_below(0.3 - ULP, 0.7, 0.9, 0, 0)};
    const std::vector<Window> holders{window_below(0.3, 0, 0.1, 0, 0), window_below(0.3, 0.9, 1, 0, 0)};
    for (const std::span<const Window> list : {std::span<const Window>(), std::span<const Window>(holders)}) {
        auto scratch = run;
        const auto joined = envelope.merge(list, scratch);
        REQUIRE(joined.size() == (list.empty() ? 1 : 2)); // the last holder is not looked at
        CHECK(joined[0].begin == (list.empty() ? 0.1 : 0));
        CHECK(joined[0].end == 0.9);
        CHECK(std::abs(joined[0].end_distance - joined[0].distance_at(0.9)) < 1e-15);
        CHECK(std::abs(envelope.lowest() - 1) < 1e-15); // below the source
    }
    // Another source, one that is farther from where it starts, light from another place, and a shadow; one
    // that was propagated, and one that comes through another face.
    Window propagated = window_below(0.3, 0.4, 0.7, 0, 0), of_other_face = propagated;
    propagated.pending = 0;
    of_other_face.from_face = 1;
    for (const Window& other : {window_below(0.3, 0.4, 0.7, 0, 1), window_below(0.3, 0.4, 0.7, 1e-9, 0),
                                window_below(0.3 + 1e-9, 0.4, 0.7, 0, 0),
                                window_below(0.3, 0.4 + 1e-9, 0.7, 0, 0), propagated, of_other_face}) {
        std::vector<Window> apart{run.front(), other};
        CHECK(envelope.merge({}, apart).size() == 2);
    }
}

TEST_CASE("envelope: tells the smallest distance that a window has won") {
    std::mt19937_64 random(4);
    Envelope envelope;
    for (int round = 0; round < 300; ++round) {
        const Window holder = random_window(random, 0);
        Window window = random_window(random, 1);
        if (!(holder.begin < holder.end) || !(window.begin < window.end)) continue;
        const auto merged = envelope.merge({&holder, 1}, {&window, 1});
        const double told = envelope.lowest();
        double smallest = HUGE_VAL;
        for (const Window& part : merged) {
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

TEST_CASE("window lists: keep what was assigned last, until it is swept away") {
    std::mt19937_64 random(7);
    constexpr uint32_t EDGES = 300;
    WindowLists lists(EDGES);
    for (int round = 0; round < 4; ++round) {
        lists.clear();
        std::map<uint32_t, std::vector<Window>> expected;
        size_t sweeps = 0, wrong = 0;
        for (uint32_t step = 0; step < 4000; ++step) {
            const auto edge = static_cast<uint32_t>(random() % EDGES);
            if (lists.closed(edge)) continue;
            const auto length = static_cast<uint32_t>(step % 97 == 0 ? 5000 : 1 + random() % 70);
            std::vector<Window> windows(length, random_window(random, step));
            lists.assign(edge, windows);
            expected[edge] = std::move(windows);
            if (!lists.crowded()) continue;
            ++sweeps;
            lists.sweep([](uint32_t e) { return e % 7 == 0; });
            std::erase_if(expected, [](const auto& entry) { return entry.first % 7 == 0; });
        }
        for (uint32_t edge = 0; edge < EDGES; ++edge) {
            const auto list = lists.at(edge);
            const auto found = expected.find(edge);
            const std::span<const Window> kept =
                found == expected.end() ? std::span<const Window>() : found->second;
            wrong += !std::ranges::equal(list, kept, [](const Window& a, const Window& b) {
                return a.nearest == b.nearest && a.begin == b.begin && a.end == b.end;
            });
        }
        CHECK(wrong == 0);
        CHECK(sweeps > 1);
    }
}
