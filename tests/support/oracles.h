#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "format/error.h"
#include "src/mesh/mesh.h"
#include "src/metric/metric.h"

namespace geodesic::test {

// An upper bound of the exact distances that converges to them: Dijkstra on the mesh with
// `points_per_edge` Steiner points on every edge, all points of a face joined by straight segments.
// Independent of the library: needs positions and faces only.
std::vector<double> steiner_distances(const Mesh& mesh, uint32_t source, uint32_t points_per_edge);

// Dijkstra without a queue over given edges, O(n^2): the distance from the nearest source.
std::vector<double> plain_dijkstra(uint32_t vertex_count, std::span<const std::array<uint32_t, 2>> edges,
                                   std::span<const double> cost, std::span<const uint32_t> sources);

// The distances of all vertices after one solve.
std::vector<double> field(const Mesh& mesh, FieldSolver& solver, std::span<const uint32_t> sources,
                          std::span<const uint32_t> targets = {}, double radius = UNREACHABLE);
std::vector<double> exact_field(const Mesh& mesh, uint32_t source);

// The largest |a - b| / b; infinities must be at the same places, otherwise it is infinity.
double largest_relative_difference(std::span<const double> a, std::span<const double> b);

// The status that `action` fails with, GEOIDX_OK when it does not. Any other exception ends the test.
template <class Action>
geoidx_status failure_of(Action&& action, std::string* detail = nullptr) {
    try {
        action();
        return GEOIDX_OK;
    } catch (const Error& error) {
        if (detail) *detail = error.what();
        return error.status;
    }
}

}
