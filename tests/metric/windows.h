#pragma once

#include <random>
#include <utility>

#include "src/metric/window.h"
#include "tests/support/meshes.h"

namespace geodesic::test {

inline Window window_over(double begin, double end, double x, double y, double sigma, uint32_t nearest) {
    Window window{begin, end, x, y, sigma, 0, 0, nearest, nearest & MAX_NEAREST, 1};
    window.begin_distance = window.distance_at(begin);
    window.end_distance = window.distance_at(end);
    return window;
}

inline Window random_window(std::mt19937_64& random, uint32_t nearest) {
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
