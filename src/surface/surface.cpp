#include "src/surface/surface.h"

#include <algorithm>
#include <cmath>

namespace geodesic {

Surface::Surface(Intake&& intake, SurfaceCosts&& given, FlatFaces&& flat)
    : average_edge(mean_edge(intake.mesh)), components(components_of(intake.mesh)),
      positions(std::move(intake.mesh.positions)), faces(std::move(intake.mesh.faces)),
      vertex_faces(intake.mesh.vertex_faces), vertex_of_id(std::move(intake.vertex_of_id)),
      id_of_vertex(std::move(intake.id_of_vertex)), face_of_triangle(std::move(intake.face_of_triangle)),
      triangle_of_face(faces.size(), NONE), corners_of_duplicate(std::move(intake.corners_of_duplicate)),
      fingerprint(intake.fingerprint), costs(std::move(given)), flat_faces(std::move(flat)) {
    for (uint32_t t = 0; t < face_of_triangle.size(); ++t)
        if (face_of_triangle[t] != NONE && !corners_of_duplicate.contains(t))
            triangle_of_face[face_of_triangle[t]] = t;
    positions.shrink_to_fit();
    faces.shrink_to_fit();
    id_of_vertex.shrink_to_fit();
    face_of_triangle.shrink_to_fit();
}

Eigen::Vector3d position_of(const Surface& surface, const SurfacePoint& point) {
    const auto& [a, b, c] = surface.faces[point.face];
    return point.weights[0] * surface.positions[a] + point.weights[1] * surface.positions[b] +
           point.weights[2] * surface.positions[c];
}

namespace {

// Divides weights by their sum, unless it is 1 but for rounding. Of a point at a corner, the weight is
// exactly 1 then.
void scale(std::array<double, 3>& weights) {
    constexpr double ROUNDED = 1e-15; // by how much a sum may be off
    const double sum = weights[0] + weights[1] + weights[2];
    if (std::ranges::count(weights, 0.0) == 2 || std::abs(sum - 1) > ROUNDED)
        for (double& weight : weights) weight /= sum;
}

}

std::array<double, 3> without_negligible(std::array<double, 3> weights) {
    scale(weights);
    for (double& weight : weights)
        if (weight < NEGLIGIBLE_WEIGHT) weight = 0;
    scale(weights);
    return weights;
}

uint32_t vertex_at(const Surface& surface, const SurfacePoint& point) {
    for (size_t k = 0; k < 3; ++k)
        if (point.weights[k] == 1) return surface.faces[point.face][k];
    return NONE;
}

SurfacePoint point_at_vertex(const Surface& surface, uint32_t vertex) {
    const auto around = surface.vertex_faces[vertex];
    const uint32_t first =
        *std::ranges::min_element(around, {}, [&](uint32_t face) { return surface.triangle_of_face[face]; });
    return corner_point(surface, first, vertex);
}

}
