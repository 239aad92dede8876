#include "src/build/finer_borders.h"

#include <algorithm>
#include <cmath>

#include "src/build/errors_by_distance.h"
#include "src/mesh/halve_edges.h"

namespace geodesic {

namespace {

std::vector<BorderEdge> edges_between_leaves(const Mesh& mesh, std::span<const uint32_t> leaf_of_face) {
    std::vector<BorderEdge> edges;
    for (uint32_t e = 0; e < mesh.edge_count(); ++e) {
        const auto faces = mesh.edge_faces[e];
        const auto in_other_leaf = [&](uint32_t f) { return leaf_of_face[f] != leaf_of_face[faces[0]]; };
        if (std::ranges::any_of(faces, in_other_leaf)) edges.push_back({e, 0});
    }
    return edges;
}

// The middles of edges, and the ends.
struct EdgePoints {
    std::vector<SurfacePoint> middles;
    std::vector<uint32_t> ends;
};

SurfacePoint middle_of(const Mesh& mesh, uint32_t edge) {
    const uint32_t face = mesh.edge_faces[edge][0];
    SurfacePoint middle{face, {0.5, 0.5, 0.5}};
    for (size_t k = 0; k < 3; ++k)
        if (mesh.face_edges[face][k] == edge) middle.weights[k] = 0;
    return middle;
}

EdgePoints points_of(const Mesh& mesh, std::span<const BorderEdge> edges) {
    EdgePoints points;
    for (const auto& [edge, deviation] : edges) {
        points.middles.push_back(middle_of(mesh, edge));
        points.ends.insert(points.ends.end(), mesh.edges[edge].begin(), mesh.edges[edge].end());
    }
    return points;
}

// In a triangle, the distance from a corner to the middle of the opposite side.
double unfolded_middle(double to_one_end, double to_other_end, double length) {
    const double twice_squares = 2 * to_one_end * to_one_end + 2 * to_other_end * to_other_end;
    return 0.5 * std::sqrt(std::max(0.0, twice_squares - length * length));
}

// Of the latest solve.
std::vector<double> deviations(const FieldSolver& solver, const Mesh& mesh, std::span<const BorderEdge> edges,
                               double too_short) {
    std::vector<double> result(edges.size(), 0);
    for (size_t i = 0; i < edges.size(); ++i) {
        const auto [a, b] = mesh.edges[edges[i].edge];
        const double exact = solver.point_distance(i), length = mesh.edge_length(edges[i].edge);
        if (!has_relative_error(exact, too_short)) continue;
        const double unfolded = unfolded_middle(solver.distance(a), solver.distance(b), length);
        result[i] = relative_error(exact, unfolded);
    }
    return result;
}

}

std::vector<BorderEdge> border_edges(const Mesh& mesh, std::span<const uint32_t> leaf_of_face,
                                     std::span<const uint32_t> sources, const ShortDistances& too_short,
                                     Workers& workers) {
    std::vector<BorderEdge> edges = edges_between_leaves(mesh, leaf_of_face);
    const EdgePoints points = points_of(mesh, edges);
    std::vector<std::vector<double>> of_source(sources.size());
    if (!edges.empty())
        workers.run(sources.size(), [&](FieldSolver& solver, size_t i) {
            solver.solve({{&sources[i], 1}, points.ends, {}, points.middles});
            of_source[i] = deviations(solver, mesh, edges, too_short.up_to(sources[i]));
        });
    for (const auto& added : of_source)
        for (size_t i = 0; i < added.size(); ++i)
            edges[i].deviation += added[i] / static_cast<double>(sources.size());
    std::ranges::stable_sort(edges, std::ranges::greater{}, &BorderEdge::deviation);
    return edges;
}

size_t count_for_share(std::span<const BorderEdge> edges, double share) {
    double sum = 0, have = 0;
    for (const BorderEdge& edge : edges) sum += edge.deviation;
    size_t count = 0;
    while (count < edges.size() && edges[count].deviation > 0 && have < share * sum)
        have += edges[count++].deviation;
    return count;
}

FinerSurface with_finer_borders(const Mesh& mesh, const Hierarchy& hierarchy,
                                std::span<const BorderEdge> edges) {
    std::vector<uint32_t> cut;
    for (const BorderEdge& edge : edges) cut.push_back(edge.edge);
    std::ranges::sort(cut); // the order of added vertices is that of the edges
    HalvedEdges halved = halve_edges(mesh, cut);
    FinerSurface finer{std::move(halved.mesh), hierarchy};
    finer.hierarchy.leaf_of_face.clear();
    for (const uint32_t face : halved.whole_face)
        finer.hierarchy.leaf_of_face.push_back(hierarchy.leaf_of_face[face]);
    return finer;
}

}
