#include "tests/support/oracles.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <queue>

#include "src/metric/window_propagation.h"

namespace geodesic::test {

namespace {

using Points = std::vector<uint32_t>;

// Vertices first, then the points on the edges.
struct SteinerGraph {
    std::vector<Eigen::Vector3d> positions;
    std::vector<Points> sides; // three a face
    std::vector<std::vector<uint32_t>> faces_of_point;

    SteinerGraph(const Mesh& mesh, uint32_t points_per_edge) : positions(mesh.positions) {
        std::map<std::array<uint32_t, 2>, Points> points_of_edge;
        for (const auto& face : mesh.faces)
            for (size_t k = 0; k < 3; ++k)
                sides.push_back(points_on(face[k], face[(k + 1) % 3], points_per_edge, points_of_edge));
        faces_of_point.resize(positions.size());
        for (size_t i = 0; i < sides.size(); ++i)
            for (uint32_t point : sides[i]) {
                auto& faces = faces_of_point[point];
                const auto face = static_cast<uint32_t>(i / 3);
                if (faces.empty() || faces.back() != face) faces.push_back(face);
            }
    }

private:
    Points points_on(uint32_t a, uint32_t b, uint32_t count,
                     std::map<std::array<uint32_t, 2>, Points>& points_of_edge) {
        const uint32_t low = std::min(a, b), high = std::max(a, b);
        const auto [entry, added] = points_of_edge.try_emplace({low, high});
        if (added) {
            entry->second.push_back(low);
            for (uint32_t i = 1; i <= count; ++i) {
                const double share = static_cast<double>(i) / (count + 1);
                entry->second.push_back(static_cast<uint32_t>(positions.size()));
                positions.push_back((1 - share) * positions[low] + share * positions[high]);
            }
            entry->second.push_back(high);
        }
        return entry->second;
    }
};

}

std::vector<double> steiner_distances(const Mesh& mesh, uint32_t source, uint32_t points_per_edge) {
    const SteinerGraph graph(mesh, points_per_edge);
    std::vector<double> distance(graph.positions.size(), UNREACHABLE);
    using Event = std::pair<double, uint32_t>;
    std::priority_queue<Event, std::vector<Event>, std::greater<>> queue;
    distance[source] = 0;
    queue.push({0, source});
    while (!queue.empty()) {
        const auto [d, point] = queue.top();
        queue.pop();
        if (d > distance[point]) continue;
        for (uint32_t face : graph.faces_of_point[point])
            for (size_t side = 3 * size_t{face}; side < 3 * size_t{face} + 3; ++side)
                for (uint32_t next : graph.sides[side]) {
                    const double through = d + (graph.positions[next] - graph.positions[point]).norm();
                    if (!(through < distance[next])) continue;
                    distance[next] = through;
                    queue.push({through, next});
                }
    }
    distance.resize(mesh.positions.size());
    return distance;
}

std::vector<double> plain_dijkstra(uint32_t vertex_count, std::span<const std::array<uint32_t, 2>> edges,
                                   std::span<const double> cost, std::span<const uint32_t> sources) {
    std::vector<std::vector<std::pair<uint32_t, double>>> arcs(vertex_count);
    for (size_t e = 0; e < edges.size(); ++e) {
        arcs[edges[e][0]].push_back({edges[e][1], cost[e]});
        arcs[edges[e][1]].push_back({edges[e][0], cost[e]});
    }
    std::vector<double> distance(vertex_count, UNREACHABLE);
    std::vector<uint8_t> done(vertex_count, 0);
    for (uint32_t source : sources) distance[source] = 0;
    for (;;) {
        uint32_t nearest = NONE;
        for (uint32_t v = 0; v < vertex_count; ++v)
            if (!done[v] && distance[v] < UNREACHABLE && (nearest == NONE || distance[v] < distance[nearest]))
                nearest = v;
        if (nearest == NONE) return distance;
        done[nearest] = 1;
        for (const auto& [to, length] : arcs[nearest])
            distance[to] = std::min(distance[to], distance[nearest] + length);
    }
}

std::vector<double> field(const Mesh& mesh, FieldSolver& solver, std::span<const uint32_t> sources,
                          std::span<const uint32_t> targets, double radius) {
    solver.solve(sources, targets, radius);
    std::vector<double> distances(mesh.vertex_count());
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) distances[v] = solver.distance(v);
    return distances;
}

std::vector<double> exact_field(const Mesh& mesh, uint32_t source) {
    return field(mesh, *ExactMetric(mesh).make_solver(), {&source, 1});
}

double largest_relative_difference(std::span<const double> a, std::span<const double> b) {
    if (a.size() != b.size()) return UNREACHABLE;
    double largest = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        if (a[i] == b[i]) continue;
        const double difference = std::abs(a[i] - b[i]) / std::abs(b[i]);
        if (!(difference <= largest)) largest = std::isnan(difference) ? UNREACHABLE : difference;
    }
    return largest;
}

}
