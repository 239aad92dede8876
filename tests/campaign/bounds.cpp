#include "tests/campaign/bounds.h"

#include <algorithm>
#include <cmath>

#include "tests/campaign/finding.h"

namespace geodesic::campaign {

namespace {

// Of a float, to either side.
constexpr double FLOAT_ROUNDING = 0x1p-24;
// Two distances of the metric that are the same can differ by so much where faces have no area, and where
// edges of a plane are flipped (docs/limits.md).
constexpr double METRIC_DIFFERENCE = 1e-6, FLIPPED_DIFFERENCE = 1e-5;
// Below this a float has fewer digits, or is 0.
constexpr double SMALLEST = 1e-36;
// Faces without area are given one (docs/limits.md), and squares of lengths are lost below their rounding.
constexpr double METRIC_ROUNDING = 1e-5;
// How much too short and too long an answer of GEOIDX_ENGINE_OVERLAY may be: gross errors only, since the
// largest ones of hard surfaces are not bounded yet.
constexpr double OVERLAY_SHORT = 0.5, OVERLAY_LONG = 2;
// Twice what is left between points of hard surfaces (docs/limits.md).
constexpr double POINT_PAIR_ERROR = 0.1;

bool is_source(const Truth& truth, const Surface& surface, uint32_t target) {
    return std::ranges::any_of(truth.sources, [&](uint32_t s) { return surface.are_one(s, target); });
}

}

// A way has two hops a level and one across. Each rounds to half a step of its table, and each passes a
// border at the vertex that stands for a pruned one, within delta of it. 16-bit tables have at least 2^14
// steps. GEOIDX_ENGINE_GRAPH rounds its tables, and the sum of a way once a hop.
Bounds::Bounds(const BuildInput& input, const geoidx_info& info, double longest)
    : is_graph_(info.engine == GEOIDX_ENGINE_GRAPH),
      unfolds_(!is_graph_ && (info.metric_flags & GEOIDX_METRIC_UNFOLDABLE) != 0),
      is_along_edges_(info.metric == GEOIDX_METRIC_EDGES), may_flip_edges_(input.may_flip_edges()) {
    for (double length : input.edge_bounds()) longest_edge_ = std::max(longest_edge_, length);
    const double hops = 2 * info.level_count + 1;
    detour_ = 2 * hops * input.options().delta / 100 * info.bounding_box_diagonal;
    share_ = (hops + 1) * FLOAT_ROUNDING + (may_flip_edges_ ? FLIPPED_DIFFERENCE : METRIC_DIFFERENCE);
    rounding_ = is_graph_ ? 0 : hops * longest / 16384;
}

double Bounds::least(double exact) const {
    if (is_graph_) return exact * (1 - share_) - SMALLEST;
    if (!unfolds_) return exact * 0.98 - rounding_ - SMALLEST;
    // A way straightened over a segment is never shorter than the way over the nearer end by more than the
    // segment is long, which says little where needles are longer than the way.
    return std::min(exact * OVERLAY_SHORT, exact - longest_edge_) - rounding_ - SMALLEST;
}

double Bounds::most(double along_edges) const {
    const double of_graph = may_flip_edges_ ? OVERLAY_LONG : 1 + share_;
    const double factor = is_graph_ ? of_graph : unfolds_ ? OVERLAY_LONG : 1.02;
    return (along_edges + 2 * detour_) * factor + rounding_ + SMALLEST;
}

Bounds::Range Bounds::of_point_field(double exact, double along_edges) const {
    return {std::min(exact * OVERLAY_SHORT, exact - longest_edge_) - rounding_ - SMALLEST,
            most(std::max(exact, along_edges)) + 4 * FLOAT_ROUNDING * longest_edge_};
}

Bounds::Range Bounds::of_point_pair(double exact, double along_edges) const {
    const Range of_field = of_point_field(exact, along_edges);
    if (is_graph_ || detour_ > 0) return of_field;
    return {exact * (1 - POINT_PAIR_ERROR) - rounding_ - SMALLEST,
            exact * (1 + POINT_PAIR_ERROR) + rounding_ + 4 * FLOAT_ROUNDING * longest_edge_ + SMALLEST};
}

// Where all ways go along edges the inequality holds but for rounding; elsewhere one answer may be as long as
// allowed, and the two as short.
double Bounds::most_over(double sum) const {
    const double factor = is_along_edges_ ? 1.02 : OVERLAY_LONG / OVERLAY_SHORT;
    const double segment = unfolds_ ? 2 * longest_edge_ : 0;
    return (sum + segment + 2 * detour_) * factor + 3 * rounding_ + SMALLEST;
}

Truth truth_of(const BuildInput& input, geoidx_solver* solver, std::span<const uint32_t> sources) {
    const Surface& surface = input.surface();
    Truth truth{{sources.begin(), sources.end()}, {}, std::vector(surface.vertex_count(), FAR)};
    truth.exact.resize(surface.vertex_count());
    succeed(geoidx_solver_distances(solver, sources.data(), static_cast<uint32_t>(sources.size()), nullptr,
                                    surface.vertex_count(), truth.exact.data()),
            "geoidx_solver_distances");
    for (uint32_t source : sources) {
        const auto field = surface.along_edges(input.edge_bounds(), source);
        for (uint32_t id = 0; id < field.size(); ++id)
            truth.along_edges[id] = std::min(truth.along_edges[id], field[id]);
    }
    return truth;
}

void check_truth(const BuildInput& input, const Truth& truth) {
    const Surface& surface = input.surface();
    const bool is_straight_bound =
        input.options().metric == GEOIDX_METRIC_EXACT && !input.options().edge_lengths;
    for (uint32_t id = 0; id < surface.vertex_count(); ++id) {
        const double d = truth.exact[id], bound = truth.along_edges[id];
        const bool is_reached =
            std::ranges::any_of(truth.sources, [&](uint32_t s) { return surface.are_joined(s, id); });
        expect((d < FAR) == is_reached && (bound < FAR) == is_reached, "solver reaches",
               "%u: %.9g, edges %.9g", id, d, bound);
        expect(d >= 0, "solver not negative", "%u: %.17g", id, d);
        if (!is_reached) continue;
        expect(d <= bound * (1 + METRIC_ROUNDING) + SMALLEST, "solver over edges",
               "%u to %u: %.17g, edges %.17g", truth.sources[0], id, d, bound);
        if (input.options().metric == GEOIDX_METRIC_EDGES)
            expect(d >= bound * (1 - METRIC_ROUNDING), "solver under edges", "%u to %u: %.17g, edges %.17g",
                   truth.sources[0], id, d, bound);
        double straight = FAR;
        for (uint32_t source : truth.sources) straight = std::min(straight, input.straight(source, id));
        if (is_straight_bound)
            expect(d >= straight * (1 - METRIC_ROUNDING), "solver under straight",
                   "%u to %u: %.17g, straight %.17g", truth.sources[0], id, d, straight);
    }
}

void check_answer(const char* query, const BuildInput& input, const Bounds& bounds, const Truth& truth,
                  uint32_t target, float answer) {
    const Surface& surface = input.surface();
    const double exact = truth.exact[target], d{answer};
    const std::string values = formatted("%u to %u: %.9g, metric %.9g, edges %.9g", truth.sources[0], target,
                                         d, exact, truth.along_edges[target]);
    const auto require = [&](bool holds, const char* what) {
        if (!holds) throw Finding(std::string(query) + ' ' + what, values);
    };
    require(!std::isnan(d), "is NaN");
    require(d >= 0, "is negative");
    require((d < FAR) == (exact < FAR), exact < FAR ? "does not reach" : "reaches");
    if (exact == FAR) return;
    if (is_source(truth, surface, target)) return require(d == 0, "is not 0 at its source");
    require(d > 0 || exact < SMALLEST, "is 0 elsewhere");
    require(d >= bounds.least(exact), "is too short");
    require(d <= bounds.most(std::max(exact, truth.along_edges[target])), "is too long");
}

}
