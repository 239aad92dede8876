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
#include "src/metric/callback.h"
#include "src/metric/edge_graph.h"
#include "src/metric/weighted_surface.h"
#include "src/metric/window_propagation.h"

namespace geodesic {

namespace {

constexpr uint32_t MOST_POINTS_PER_EDGE = 1000;

[[noreturn]] void bad_mesh(const std::string& detail) { throw Error(GEOIDX_ERROR_BAD_MESH, detail); }

uint32_t vertex_of_id(const Intake& intake, uint32_t id) {
    if (id >= intake.vertex_of_id.size()) refuse_argument("an edge cost names vertex " + std::to_string(id));
    return intake.vertex_of_id[id];
}

std::string edge_name(uint32_t a, uint32_t b) {
    return "the edge between vertices " + std::to_string(a) + " and " + std::to_string(b);
}

// The length of each edge or, where the caller gives a cost for it, that cost.
std::vector<double> edge_costs(const Intake& intake, const geoidx_build_options& options) {
    std::vector<double> costs = edge_lengths(intake.mesh);
    if (options.edge_cost_count == 0) return costs;
    if (!options.edge_cost_vertices || !options.edge_costs)
        refuse_argument("edge_cost_count is set, but not its arrays");
    std::vector<uint8_t> given(costs.size(), 0);
    for (uint32_t i = 0; i < options.edge_cost_count; ++i) {
        const uint32_t a = options.edge_cost_vertices[2 * size_t{i}];
        const uint32_t b = options.edge_cost_vertices[2 * size_t{i} + 1];
        const double cost = options.edge_costs[i];
        if (!(cost >= 0) || !std::isfinite(cost))
            refuse_argument(edge_name(a, b) + " has the cost " + std::to_string(cost));
        const uint32_t from = vertex_of_id(intake, a), to = vertex_of_id(intake, b);
        const uint32_t edge = from == NONE || to == NONE ? NONE : find_edge(intake.mesh, from, to);
        if (edge == NONE) refuse_argument(edge_name(a, b) + " is given a cost, but is no edge of the mesh");
        costs[edge] = given[edge] ? std::min(costs[edge], cost) : cost;
        given[edge] = 1;
    }
    return costs;
}

// The cost of each face. If several triangles are one face, the cheapest counts. The costs of dropped
// triangles are checked, too.
std::vector<double> face_costs(const Intake& intake, const geoidx_build_options& options) {
    if (!options.face_costs) refuse_argument("metric is GEOIDX_METRIC_WEIGHTED, but face_costs is NULL");
    if (options.face_cost_count != intake.face_of_triangle.size())
        refuse_argument("face_cost_count is " + std::to_string(options.face_cost_count) +
                        ", but the mesh has " + std::to_string(intake.face_of_triangle.size()) +
                        " triangles");
    std::vector<double> costs(intake.mesh.face_count(), UNREACHABLE);
    for (uint64_t t = 0; t < options.face_cost_count; ++t) {
        const double cost = options.face_costs[t];
        if (!(cost > 0) || !std::isfinite(cost))
            refuse_argument("triangle " + std::to_string(t) + " has the cost " + std::to_string(cost));
        const uint32_t face = intake.face_of_triangle[t];
        if (face != NONE) costs[face] = std::min(costs[face], cost);
    }
    return costs;
}

// The sides of one of the caller's triangles, each opposite to a corner.
void check_sides(uint64_t triangle, std::span<const double, 3> sides) {
    const std::string name = "triangle " + std::to_string(triangle);
    for (double side : sides)
        if (!(side >= double{FLT_MIN} && side <= double{FLT_MAX}))
            bad_mesh(name + " has a side of length " + std::to_string(side));
    for (size_t k = 0; k < 3; ++k) {
        const double others = sides[(k + 1) % 3] + sides[(k + 2) % 3];
        if (sides[k] > others) bad_mesh(name + " has a side longer than the two others together");
        if (sides[k] == others) bad_mesh(name + " has no area: a side is as long as the two others together");
    }
}

// The lengths that the caller gives for the edges of the mesh, or nothing if it gives none.
std::vector<double> own_lengths(const geoidx_mesh& mesh, const Intake& intake,
                                const geoidx_build_options& options) {
    if (options.edge_length_count == 0) return {};
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
                bad_mesh(edge_name(a, b) + " has two lengths: " + std::to_string(length) + " and " +
                         std::to_string(sides[k]) + " in triangle " + std::to_string(t));
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

uint64_t hash_of(const void* data, uint64_t size, uint64_t seed) {
    return XXH3_64bits_withSeed(data, size, seed);
}

}

IntakeOptions intake_options(const geoidx_build_options& options) {
    return {options.weld_tolerance, options.refuse_edges_of_many != 0};
}

std::unique_ptr<Metric> make_metric(const geoidx_mesh& mesh, const Intake& intake,
                                    const geoidx_build_options& options) {
    switch (options.metric) {
    case GEOIDX_METRIC_EXACT:
        return std::make_unique<ExactMetric>(intake.mesh, own_lengths(mesh, intake, options));
    case GEOIDX_METRIC_EDGES:
        return std::make_unique<EdgeGraphMetric>(intake.mesh, edge_costs(intake, options));
    case GEOIDX_METRIC_CALLBACK:
        if (!options.metric_callback)
            refuse_argument("metric is GEOIDX_METRIC_CALLBACK, but metric_callback is NULL");
        return std::make_unique<CallbackMetric>(options.metric_callback, options.metric_user,
                                                intake.id_of_vertex);
    case GEOIDX_METRIC_WEIGHTED:
        if (options.points_per_edge > MOST_POINTS_PER_EDGE)
            refuse_argument("points_per_edge is " + std::to_string(options.points_per_edge) + ", more than " +
                            std::to_string(MOST_POINTS_PER_EDGE));
        return std::make_unique<WeightedMetric>(intake.mesh, face_costs(intake, options),
                                                options.points_per_edge, own_lengths(mesh, intake, options));
    default:
        refuse_argument("metric " + std::to_string(options.metric) + " is not a GEOIDX_METRIC_*");
    }
}

uint32_t metric_flags(const geoidx_build_options& options) {
    if (options.metric == GEOIDX_METRIC_EXACT) return GEOIDX_METRIC_UNFOLDABLE;
    return options.metric == GEOIDX_METRIC_CALLBACK ? options.metric_flags : 0;
}

uint64_t metric_fingerprint(const geoidx_build_options& options) {
    const bool by_surface = options.metric == GEOIDX_METRIC_EXACT || options.metric == GEOIDX_METRIC_WEIGHTED;
    uint64_t hash = 0;
    if (options.metric == GEOIDX_METRIC_EDGES && options.edge_cost_count > 0) {
        hash = hash_of(options.edge_cost_vertices, 2 * uint64_t{options.edge_cost_count} * sizeof(uint32_t),
                       hash);
        hash = hash_of(options.edge_costs, options.edge_cost_count * sizeof(double), hash);
    }
    if (options.metric == GEOIDX_METRIC_WEIGHTED)
        hash = hash_of(options.face_costs, options.face_cost_count * sizeof(double), options.points_per_edge);
    if (by_surface && options.edge_length_count > 0)
        hash = hash_of(options.edge_lengths, options.edge_length_count * sizeof(double), hash);
    return hash;
}

}
