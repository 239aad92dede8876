#include "tests/campaign/random_options.h"

#include <sstream>

namespace geodesic::campaign {

namespace {

double diagonal(const test::Soup& soup) {
    Eigen::Vector3d low = soup.positions[0], high = low;
    for (const auto& p : soup.positions) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    return (high - low).norm();
}

// A callback answers from a square of distances, which must not be large.
void choose_metric(Dice& dice, CaseOptions& options, uint32_t vertices) {
    constexpr uint32_t MOST_OF_CALLBACK = 200, MOST_OF_WEIGHTED = 500;
    const double kind = dice.real(0, 1);
    if (kind < 0.15) options.metric = GEOIDX_METRIC_EDGES;
    if (kind > 0.85 && vertices < MOST_OF_CALLBACK) options.metric = GEOIDX_METRIC_CALLBACK;
    if (kind > 0.7 && kind < 0.8 && vertices < MOST_OF_WEIGHTED) options.metric = GEOIDX_METRIC_WEIGHTED;
    options.callback =
        dice.pick<uint32_t>({CALLBACK_EXACT, CALLBACK_UNFOLDABLE, CALLBACK_EDGES, CALLBACK_STRAIGHT});
    options.points_per_edge = dice.between(0, 4);
    if (dice.chance(0.6)) options.cost_seed = dice.bits();
    options.own_lengths = dice.chance(0.05);
}

void choose_hierarchy(Dice& dice, CaseOptions& options) {
    options.engine = dice.chance(0.35) ? GEOIDX_ENGINE_GRAPH : GEOIDX_ENGINE_OVERLAY;
    if (dice.chance(0.5)) {
        options.level_count = dice.between(1, 4);
        for (uint32_t l = 0; l < options.level_count; ++l)
            options.patches[l] = dice.chance(0.3) ? 0 : dice.between(2, l == 0 ? 12 : 5);
    }
    options.lloyd_iterations = dice.between(0, 6);
    options.exact_vertices = dice.pick({400u, 400u, 1u, 20u, 60u, 1000u});
    options.delta = dice.chance(0.8) ? 0 : dice.pick({0.1, 1.0, 5.0, 30.0});
}

// visit(name, value) for each.
template <class Visit>
void each_option(CaseOptions& options, const Visit& visit) {
    visit("engine", options.engine);
    visit("metric", options.metric);
    visit("callback", options.callback);
    visit("level_count", options.level_count);
    for (int l = 0; l < 8; ++l) visit(("patches" + std::to_string(l)).c_str(), options.patches[l]);
    visit("lloyd_iterations", options.lloyd_iterations);
    visit("exact_vertices", options.exact_vertices);
    visit("points_per_edge", options.points_per_edge);
    visit("threads", options.threads);
    visit("delta", options.delta);
    visit("weld_tolerance", options.weld_tolerance);
    visit("target_error", options.target_error);
    visit("seed", options.seed);
    visit("cost_seed", options.cost_seed);
    visit("own_lengths", options.own_lengths);
    visit("floats", options.floats);
    visit("opened", options.opened);
    visit("query_seed", options.query_seed);
    visit("store_mesh", options.store_mesh);
}

}

CaseOptions random_options(Dice& dice, const test::Soup& soup) {
    CaseOptions options;
    choose_hierarchy(dice, options);
    choose_metric(dice, options, soup.vertex_count());
    options.threads = dice.between(1, 4);
    options.seed = dice.bits();
    options.floats = dice.chance(0.3);
    options.opened = dice.chance(0.4);
    if (dice.chance(0.1)) options.weld_tolerance = diagonal(soup) * dice.pick({1e-9, 1e-3, 0.02});
    options.query_seed = dice.bits();
    options.target_error = dice.pick({0.0, 0.0005, 0.0005, 1e-9});
    options.store_mesh = dice.chance(0.4);
    return options;
}

std::string described(const CaseOptions& options) {
    std::ostringstream text;
    text.precision(17);
    CaseOptions copy = options;
    each_option(copy, [&](const char* name, const auto& value) { text << name << ' ' << value << '\n'; });
    return text.str();
}

CaseOptions read_options(const std::string& text) {
    CaseOptions options;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string first;
        words >> first;
        each_option(options, [&](const char* name, auto& value) {
            if (first == name) words >> value;
        });
    }
    return options;
}

}
