#include "src/build/metric_options.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <span>
#include <string>

#include <xxhash.h>

#include "format/error.h"
#include "src/base/number_text.h"
#include "src/metric/callback.h"
#include "src/metric/edge_graph.h"
#include "src/metric/given_costs.h"
#include "src/metric/weighted_surface.h"
#include "src/metric/window_propagation.h"

namespace geodesic {

namespace {

constexpr double LARGEST_TOLERANCE = 1e-4;

[[noreturn]] void bad_mesh(const std::string& detail) { throw Error(GEOIDX_ERROR_BAD_MESH, detail); }

// Whether the metric is one of ways over faces, whose shape lengths of edges can give.
bool is_by_surface(const geoidx_build_options& options) {
    return options.metric == GEOIDX_METRIC_EXACT || options.metric == GEOIDX_METRIC_WEIGHTED;
}

[[noreturn]] void refuse_option(const std::string& name, const std::string& metrics) {
    refuse_argument(name + " is set, but only " + metrics + " takes that");
}

[[noreturn]] void refuse_small_cost(const std::string& name, double cost) {
    throw Error(GEOIDX_ERROR_LIMIT, name + " has the cost " + number_text(cost) +
                                        ", too small: distances would not fit a 32-bit float");
}

std::string name_of_edge(const Intake& intake, uint32_t edge) {
    const auto& [a, b] = intake.mesh.edges[edge];
    const auto [first, second] = std::minmax(intake.id_of_vertex[a], intake.id_of_vertex[b]);
    return edge_name(first, second);
}

// The length of each edge or, where the caller gives a cost for it, that cost.
std::vector<double> edge_costs(const Intake& intake, const geoidx_build_options& options) {
    std::vector<double> costs = edge_lengths(intake.mesh);
    for (const auto& [edge, cost] : checked_edge_costs(intake, edge_costs_of(options))) {
        if (cost > 0 && cost < double{FLT_MIN}) refuse_small_cost(name_of_edge(intake, edge), cost);
        costs[edge] = cost;
    }
    return costs;
}

// `costs` are those of the caller's triangles. Sides that are too short for a float by themselves are left
// out: no cost is to blame for these.
void require_costs_fit(const Intake& intake, std::span<const double> costs, std::span<const double> lengths) {
    for (uint64_t t = 0; t < intake.face_of_triangle.size(); ++t) {
        const uint32_t face = intake.face_of_triangle[t];
        if (face == NONE) continue;
        for (const uint32_t edge : intake.mesh.face_edges[face])
            if (lengths[edge] >= double{FLT_MIN} && costs[t] * lengths[edge] < double{FLT_MIN})
                refuse_small_cost("triangle " + std::to_string(t), costs[t]);
    }
}

std::vector<double> face_costs(const Intake& intake, const geoidx_build_options& options,
                               std::span<const double> own_lengths) {
    if (!options.face_costs) refuse_argument("metric is GEOIDX_METRIC_WEIGHTED, but face_costs is NULL");
    std::vector<double> costs = checked_face_costs(intake, face_costs_of(options));
    require_costs_fit(intake, {options.face_costs, intake.face_of_triangle.size()},
                      own_lengths.empty() ? edge_lengths(intake.mesh) : own_lengths);
    return costs;
}

std::unique_ptr<Metric> make_weighted_metric(const geoidx_mesh& mesh, const Intake& intake,
                                             const geoidx_build_options& options) {
    check_points_per_edge(options.points_per_edge);
    const std::vector<double> lengths = given_lengths(mesh, intake, options);
    return std::make_unique<WeightedMetric>(intake.mesh, face_costs(intake, options, lengths),
                                            options.points_per_edge, lengths);
}

// The sides of one of the caller's triangles, each opposite to a corner.
void check_sides(uint64_t triangle, std::span<const double, 3> sides) {
    const std::string name = "triangle " + std::to_string(triangle);
    for (double side : sides)
        if (!(side >= double{FLT_MIN} && side <= double{FLT_MAX}))
            bad_mesh(name + " has a side of length " + number_text(side));
    for (size_t k = 0; k < 3; ++k) {
        const double others = sides[(k + 1) % 3] + sides[(k + 2) % 3];
        if (sides[k] > others) bad_mesh(name + " has a side longer than the two others together");
        if (sides[k] == others) bad_mesh(name + " has no area: a side is as long as the two others together");
    }
}

}

void check_metric_options(const geoidx_build_options& options) {
    if (!(options.solver_tolerance >= 0 && options.solver_tolerance <= LARGEST_TOLERANCE))
        refuse_argument("solver_tolerance is " + number_text(options.solver_tolerance) + ", not in 0 .. " +
                        number_text(LARGEST_TOLERANCE));
    if (options.edge_cost_count > 0 && options.metric != GEOIDX_METRIC_EDGES)
        refuse_option(options.edge_costs ? "edge_costs" : "edge_cost_count", "GEOIDX_METRIC_EDGES");
    if ((options.face_costs || options.face_cost_count > 0) && options.metric != GEOIDX_METRIC_WEIGHTED)
        refuse_option(options.face_costs ? "face_costs" : "face_cost_count", "GEOIDX_METRIC_WEIGHTED");
    if ((options.edge_lengths || options.edge_length_count > 0) && !is_by_surface(options))
        refuse_option(options.edge_lengths ? "edge_lengths" : "edge_length_count",
                      "GEOIDX_METRIC_EXACT or GEOIDX_METRIC_WEIGHTED");
    if (options.metric_flags & ~uint32_t{GEOIDX_METRIC_UNFOLDABLE})
        refuse_argument("metric_flags is " + std::to_string(options.metric_flags) +
                        ", which has unknown flags");
    if (options.refuse_edges_of_many > 1)
        refuse_argument("refuse_edges_of_many is " + std::to_string(options.refuse_edges_of_many) +
                        ", not 0 or 1");
}

IntakeOptions intake_options(const geoidx_build_options& options) {
    return {options.weld_tolerance, options.refuse_edges_of_many != 0};
}

std::vector<double> given_lengths(const geoidx_mesh& mesh, const Intake& intake,
                                  const geoidx_build_options& options) {
    if (!options.edge_lengths && options.edge_length_count == 0) return {};
    if (!options.edge_lengths) refuse_argument("edge_length_count is set, but edge_lengths is NULL");
    if (options.edge_length_count != 3 * mesh.triangle_count)
        refuse_argument("edge_length_count is " + std::to_string(options.edge_length_count) +
                        ", not three for each of " + std::to_string(mesh.triangle_count) + " triangles");
    constexpr double AGREEMENT = 1e-9;
    std::vector<double> lengths(intake.mesh.edge_count(), 0);
    for (uint64_t t = 0; t < mesh.triangle_count; ++t) {
        if (intake.face_of_triangle[t] == NONE) continue;
        const std::span<const double, 3> sides(options.edge_lengths + 3 * t, 3);
        check_sides(t, sides);
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = mesh.triangles[3 * t + (k + 1) % 3], b = mesh.triangles[3 * t + (k + 2) % 3];
            double& length = lengths[find_edge(intake.mesh, intake.vertex_of_id[a], intake.vertex_of_id[b])];
            if (length != 0 && std::abs(length - sides[k]) > AGREEMENT * length)
                bad_mesh(edge_name(a, b) + " has two lengths: " + number_text(length) + " and " +
                         number_text(sides[k]) + " in triangle " + std::to_string(t));
            if (length == 0) length = sides[k];
        }
    }
    // The sides of a triangle are those that were kept: the first length given for each edge.
    for (uint64_t t = 0; t < mesh.triangle_count; ++t) {
        const uint32_t face = intake.face_of_triangle[t];
        if (face == NONE) continue;
        const auto& edges = intake.mesh.face_edges[face];
        check_sides(t, std::array{lengths[edges[0]], lengths[edges[1]], lengths[edges[2]]});
    }
    return lengths;
}

std::unique_ptr<Metric> make_metric(const geoidx_mesh& mesh, const Intake& intake,
                                    const geoidx_build_options& options, double tolerance) {
    switch (options.metric) {
    case GEOIDX_METRIC_EXACT:
        return std::make_unique<ExactMetric>(intake.mesh, tolerance, given_lengths(mesh, intake, options));
    case GEOIDX_METRIC_EDGES:
        return std::make_unique<EdgeGraphMetric>(intake.mesh, edge_costs(intake, options));
    case GEOIDX_METRIC_CALLBACK:
        if (!options.metric_callback)
            refuse_argument("metric is GEOIDX_METRIC_CALLBACK, but metric_callback is NULL");
        return std::make_unique<CallbackMetric>(options.metric_callback, options.metric_user,
                                                intake.id_of_vertex);
    case GEOIDX_METRIC_WEIGHTED:
        return make_weighted_metric(mesh, intake, options);
    default:
        refuse_argument("metric " + std::to_string(options.metric) + " is not a GEOIDX_METRIC_*");
    }
}

double tolerance_of_tables(const geoidx_build_options& options) {
    return options.engine == GEOIDX_ENGINE_OVERLAY ? 1e-5 : 0;
}

uint32_t metric_flags(const geoidx_build_options& options) {
    if (options.metric == GEOIDX_METRIC_EXACT) return GEOIDX_METRIC_UNFOLDABLE;
    return options.metric == GEOIDX_METRIC_CALLBACK ? options.metric_flags : 0;
}

uint64_t metric_fingerprint(const geoidx_build_options& options) {
    uint64_t hash = 0;
    if (options.metric == GEOIDX_METRIC_EDGES) hash = fingerprint(edge_costs_of(options));
    if (options.metric == GEOIDX_METRIC_WEIGHTED)
        hash = fingerprint(face_costs_of(options), options.points_per_edge);
    if (options.edge_length_count > 0)
        hash = XXH3_64bits_withSeed(options.edge_lengths, options.edge_length_count * sizeof(double), hash);
    return hash;
}

}
