#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/mesh/intake.h"

namespace geodesic {

// Costs as the caller gives them, by ids and triangles of its own. The checks throw Error INVALID_ARGUMENT
// that names what is wrong.

struct GivenEdgeCosts {
    uint32_t count;           // 0: the arrays are not read
    const uint32_t* vertices; // two ids an edge
    const double* costs;
};

struct GivenFaceCosts {
    const double* costs; // not NULL
    uint64_t count;
};

// Those of complete geoidx_build_options or geoidx_surface_options.
template <class Options>
GivenEdgeCosts edge_costs_of(const Options& options) {
    return {options.edge_cost_count, options.edge_cost_vertices, options.edge_costs};
}
template <class Options>
GivenFaceCosts face_costs_of(const Options& options) {
    return {options.face_costs, options.face_cost_count};
}

// The cost of an edge of the mesh, finite and not negative.
struct EdgeCost {
    uint32_t edge;
    double cost;
};

// What messages call an edge, by the caller's ids.
std::string edge_name(uint32_t a, uint32_t b);

// Each edge that is given a cost once, with its least one.
std::vector<EdgeCost> checked_edge_costs(const Intake& intake, const GivenEdgeCosts& given);

// The cost of each face. If several triangles are one face, the cheapest counts. The costs of dropped
// triangles are checked, too.
std::vector<double> checked_face_costs(const Intake& intake, const GivenFaceCosts& given);

void check_points_per_edge(uint32_t points_per_edge);

// Hashes of the costs in the caller's order, by which an index knows its own; 0 if there are no edge costs.
uint64_t fingerprint(const GivenEdgeCosts& given);
uint64_t fingerprint(const GivenFaceCosts& given, uint32_t points_per_edge);

}
