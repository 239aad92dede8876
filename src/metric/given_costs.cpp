#include "src/metric/given_costs.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <xxhash.h>

#include "format/error.h"
#include "src/base/number_text.h"
#include "src/metric/metric.h"

namespace geodesic {

namespace {

uint32_t vertex_of_id(const Intake& intake, uint32_t id) {
    if (id >= intake.vertex_of_id.size()) refuse_argument("an edge cost names vertex " + std::to_string(id));
    return intake.vertex_of_id[id];
}

EdgeCost checked_edge_cost(const Intake& intake, uint32_t a, uint32_t b, double cost) {
    if (!(cost >= 0) || !std::isfinite(cost))
        refuse_argument(edge_name(a, b) + " has the cost " + number_text(cost));
    const uint32_t from = vertex_of_id(intake, a), to = vertex_of_id(intake, b);
    const uint32_t edge = from == NONE || to == NONE ? NONE : find_edge(intake.mesh, from, to);
    if (edge == NONE) refuse_argument(edge_name(a, b) + " is given a cost, but is no edge of the mesh");
    return {edge, cost};
}

}

std::string edge_name(uint32_t a, uint32_t b) {
    return "the edge between vertices " + std::to_string(a) + " and " + std::to_string(b);
}

std::vector<EdgeCost> checked_edge_costs(const Intake& intake, const GivenEdgeCosts& given) {
    if (given.count == 0) return {};
    if (!given.vertices || !given.costs) refuse_argument("edge_cost_count is set, but not its arrays");
    std::vector<EdgeCost> costs;
    for (size_t i = 0; i < given.count; ++i)
        costs.push_back(
            checked_edge_cost(intake, given.vertices[2 * i], given.vertices[2 * i + 1], given.costs[i]));
    const auto parts = [](const EdgeCost& of) { return std::pair(of.edge, of.cost); };
    std::ranges::sort(costs, {}, parts);
    const auto is_same_edge = [](const EdgeCost& a, const EdgeCost& b) { return a.edge == b.edge; };
    costs.erase(std::unique(costs.begin(), costs.end(), is_same_edge), costs.end());
    return costs;
}

std::vector<double> checked_face_costs(const Intake& intake, const GivenFaceCosts& given) {
    if (given.count != intake.face_of_triangle.size())
        refuse_argument("face_cost_count is " + std::to_string(given.count) + ", but the mesh has " +
                        std::to_string(intake.face_of_triangle.size()) + " triangles");
    std::vector<double> costs(intake.mesh.face_count(), UNREACHABLE);
    for (uint64_t t = 0; t < given.count; ++t) {
        const double cost = given.costs[t];
        if (!(cost > 0) || !std::isfinite(cost))
            refuse_argument("triangle " + std::to_string(t) + " has the cost " + number_text(cost));
        const uint32_t face = intake.face_of_triangle[t];
        if (face != NONE) costs[face] = std::min(costs[face], cost);
    }
    return costs;
}

void check_points_per_edge(uint32_t points_per_edge) {
    constexpr uint32_t MOST = 1000;
    if (points_per_edge > MOST)
        refuse_argument("points_per_edge is " + std::to_string(points_per_edge) + ", more than " +
                        std::to_string(MOST));
}

uint64_t fingerprint(const GivenEdgeCosts& given) {
    if (given.count == 0) return 0;
    const uint64_t of_vertices =
        XXH3_64bits_withSeed(given.vertices, 2 * uint64_t{given.count} * sizeof(uint32_t), 0);
    return XXH3_64bits_withSeed(given.costs, given.count * sizeof(double), of_vertices);
}

uint64_t fingerprint(const GivenFaceCosts& given, uint32_t points_per_edge) {
    return XXH3_64bits_withSeed(given.costs, given.count * sizeof(double), points_per_edge);
}

}
