#include "src/surface/costs.h"

#include <algorithm>

#include "format/error.h"
#include "src/metric/given_costs.h"

namespace geodesic {

SurfaceCosts surface_costs(const Intake& intake, const geoidx_surface_options& options) {
    SurfaceCosts costs;
    const GivenEdgeCosts of_edges = edge_costs_of(options);
    for (const auto& [edge, cost] : checked_edge_costs(intake, of_edges)) {
        const auto& [a, b] = intake.mesh.edges[edge];
        costs.of_edge[edge_key(a, b)] = cost;
    }
    costs.edge_fingerprint = fingerprint(of_edges);
    if (options.face_cost_count == 0) return costs;
    if (!options.face_costs) refuse_argument("face_cost_count is set, but face_costs is NULL");
    check_points_per_edge(options.points_per_edge);
    costs.of_face = checked_face_costs(intake, face_costs_of(options));
    costs.face_fingerprint = fingerprint(face_costs_of(options), options.points_per_edge);
    costs.points_per_edge = options.points_per_edge;
    return costs;
}

double edge_cost(const Surface& surface, uint32_t a, uint32_t b) {
    const auto found = surface.costs.of_edge.find(edge_key(a, b));
    return found != surface.costs.of_edge.end() ? found->second
                                                : (surface.positions[a] - surface.positions[b]).norm();
}

uint32_t cheapest_face_at(const Surface& surface, uint32_t face, uint32_t a, uint32_t b) {
    const std::vector<double>& cost = surface.costs.of_face;
    uint32_t cheapest = face;
    for_each_face_beyond(surface, face, a, b, [&](uint32_t other) {
        if (cost[other] < cost[cheapest]) cheapest = other;
    });
    return cheapest;
}

}
