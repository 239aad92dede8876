#include "tests/campaign/build_input.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/campaign/finding.h"
#include "tests/support/surface_options.h"

namespace geodesic::campaign {

namespace {

std::vector<float> in_floats(const test::Soup& soup) {
    std::vector<float> result;
    for (const auto& p : soup.positions)
        for (int k = 0; k < 3; ++k) result.push_back(static_cast<float>(p[k]));
    return result;
}

test::Soup with_positions(const test::Soup& soup, const std::vector<float>& positions) {
    test::Soup result = soup;
    for (size_t i = 0; i < positions.size(); ++i)
        result.positions[i / 3][static_cast<int>(i % 3)] = double{positions[i]};
    return result;
}

}

void succeed(geoidx_status status, const char* call) {
    expect(status == GEOIDX_OK, call, "%s, %s", geoidx_status_string(status), geoidx_last_error());
}

BuildInput::BuildInput(const test::Soup& soup, const CaseOptions& chosen)
    : chosen_(chosen), positions_(chosen.floats ? in_floats(soup) : std::vector<float>{}),
      soup_(with_positions(soup, positions_)), surface_(soup_, chosen.weld_tolerance) {
    mesh_ = test::view_of(soup_);
    if (chosen.floats) {
        mesh_.positions = positions_.data();
        mesh_.position_type = GEOIDX_POSITION_FLOAT;
        mesh_.position_stride = 0;
    }
    geoidx_build_options_init(&options_);
    options_.metric = chosen.metric;
    options_.engine = chosen.engine;
    options_.level_count = chosen.level_count;
    std::ranges::copy(chosen.patches, options_.patches);
    options_.lloyd_iterations = chosen.lloyd_iterations;
    options_.exact_vertices = chosen.exact_vertices;
    options_.points_per_edge = chosen.points_per_edge;
    options_.threads = chosen.threads;
    options_.delta = chosen.delta;
    options_.target_error = chosen.target_error;
    options_.weld_tolerance = chosen.weld_tolerance;
    options_.seed = chosen.seed;
    options_.store_mesh = chosen.store_mesh;
    for (const auto& [a, b] : surface_.edges()) edge_bounds_.push_back(straight(a, b));
    const bool by_surface = chosen.metric == GEOIDX_METRIC_EXACT || chosen.metric == GEOIDX_METRIC_WEIGHTED;
    if (chosen.own_lengths && by_surface)
        give_lengths();
    else if (chosen.metric != GEOIDX_METRIC_EDGES)
        allow_for_faces_without_area();
    if (chosen.metric == GEOIDX_METRIC_EDGES && chosen.cost_seed) give_edge_costs();
    if (chosen.metric == GEOIDX_METRIC_WEIGHTED) give_face_costs();
    if (chosen.metric == GEOIDX_METRIC_CALLBACK) measure_callback();
}

double BuildInput::straight(uint32_t a, uint32_t b) const {
    return (soup_.positions[surface_.representative(a)] - soup_.positions[surface_.representative(b)]).norm();
}

// The same for the same vertices, whatever else the mesh has: 0.1 to 10.
double BuildInput::random_cost(uint64_t a, uint64_t b) const {
    Dice dice(chosen_.cost_seed ^ (a * 0x9E3779B97F4A7C15u + b));
    return std::pow(10.0, dice.real(-1, 1));
}

// Where there are such faces, the library counts all edges as longer by 2e-15 of the longest
// (docs/limits.md), and by what rounding makes of a difference of two sides. That is much of an edge that is
// very short.
void BuildInput::allow_for_faces_without_area() {
    constexpr double SHARE = 2e-15 + 4 * std::numeric_limits<double>::epsilon();
    double longest = 0;
    for (double length : edge_bounds_) longest = std::max(longest, length);
    for (double& length : edge_bounds_) length += SHARE * longest;
}

// Roots of lengths obey the triangle inequality, too, with area to spare.
void BuildInput::give_lengths() {
    double longest = 0;
    for (double length : edge_bounds_) longest = std::max(longest, length);
    const auto changed = [&](double length) { return longest * std::pow(length / longest, 0.9); };
    lengths_.assign(3 * soup_.triangles.size(), longest);
    for (const auto& [number, v] : surface_.triangles())
        for (size_t k = 0; k < 3; ++k)
            lengths_[3 * size_t{number} + k] = changed(straight(v[(k + 1) % 3], v[(k + 2) % 3]));
    for (double& length : edge_bounds_) length = changed(length);
    options_.edge_lengths = lengths_.data();
    options_.edge_length_count = lengths_.size();
}

void BuildInput::give_edge_costs() {
    for (size_t e = 0; e < edge_bounds_.size(); ++e) {
        const auto& [a, b] = surface_.edges()[e];
        const double cost = random_cost(a, b);
        edge_costs_.push_back(edge_bounds_[e] *= cost < 0.15 ? 0 : cost);
    }
    options_.edge_cost_vertices = surface_.edges().data()->data();
    options_.edge_costs = edge_costs_.data();
    options_.edge_cost_count = static_cast<uint32_t>(edge_costs_.size());
}

// Along an edge the cheapest triangle counts.
void BuildInput::give_face_costs() {
    face_costs_.assign(soup_.triangles.size(), 1);
    std::vector<double> cheapest(edge_bounds_.size(), FAR);
    for (const auto& [number, v] : surface_.triangles()) {
        const double cost = face_costs_[number] = random_cost(number, 0);
        for (size_t k = 0; k < 3; ++k) {
            const Surface::Edge edge{std::min(v[k], v[(k + 1) % 3]), std::max(v[k], v[(k + 1) % 3])};
            const auto found = std::ranges::lower_bound(surface_.edges(), edge);
            double& least = cheapest[static_cast<size_t>(found - surface_.edges().begin())];
            least = std::min(least, cost);
        }
    }
    for (size_t e = 0; e < edge_bounds_.size(); ++e) edge_bounds_[e] *= cheapest[e];
    options_.face_costs = face_costs_.data();
    options_.face_cost_count = face_costs_.size();
}

void BuildInput::measure_callback() {
    const uint32_t count = surface_.vertex_count();
    options_.metric_callback = answer;
    options_.metric_user = this;
    if (chosen_.callback == CALLBACK_UNFOLDABLE) options_.metric_flags = GEOIDX_METRIC_UNFOLDABLE;
    if (!surface_.has_triangles()) return;
    geoidx_build_options plain;
    geoidx_build_options_init(&plain);
    plain.metric = chosen_.callback == CALLBACK_EDGES ? GEOIDX_METRIC_EDGES : GEOIDX_METRIC_EXACT;
    plain.weld_tolerance = chosen_.weld_tolerance;
    geoidx_solver* made = nullptr;
    succeed(geoidx_solver_create(&mesh_, &plain, &made), "solver of the callback");
    const SolverHandle solver(made);
    square_.resize(size_t{count} * count);
    for (uint32_t source = 0; source < count; ++source) {
        double* const row = square_.data() + size_t{source} * count;
        succeed(geoidx_solver_distances(made, &source, 1, nullptr, count, row), "distances of the callback");
        if (chosen_.callback == CALLBACK_STRAIGHT)
            for (uint32_t id = 0; id < count; ++id)
                if (row[id] < FAR) row[id] = straight(source, id);
    }
    // Symmetric to the last bit, as the header asks of a metric.
    for (uint32_t a = 0; a < count; ++a)
        for (uint32_t b = 0; b < a; ++b) square_[size_t{b} * count + a] = square_[size_t{a} * count + b];
}

geoidx_status BuildInput::answer(void* user, uint32_t source, const uint32_t* targets, uint32_t count,
                                 double* distances) {
    const auto* const self = static_cast<const BuildInput*>(user);
    const double* const row = self->square_.data() + size_t{source} * self->surface_.vertex_count();
    for (uint32_t i = 0; i < count; ++i) distances[i] = row[targets[i]];
    return GEOIDX_OK;
}

SurfaceHandle BuildInput::make_surface() const {
    const geoidx_surface_options options = test::surface_options(options_);
    geoidx_surface* made = nullptr;
    succeed(geoidx_surface_create(&mesh_, &options, &made), "geoidx_surface_create");
    return SurfaceHandle(made);
}

SolverHandle BuildInput::make_solver() const {
    geoidx_solver* made = nullptr;
    succeed(geoidx_solver_create(&mesh_, &options_, &made), "geoidx_solver_create");
    return SolverHandle(made);
}

}
