#include "src/path/face_points.h"

#include <algorithm>
#include <string>

#include "format/error.h"
#include "geoidx.h"

namespace geodesic {

namespace {

// As a point of the faces that the index was made on.
FlatFaces::Point unfolded_point(const Surface& surface, const SurfacePoint& point) {
    const auto& corners = surface.faces[point.face];
    if (vertex_at(surface, point) == NONE)
        if (const auto flat = surface.flat_faces.find(surface, point)) return *flat;
    FlatFaces::Point same{corners, point.weights, {}};
    for (size_t k = 0; k < 3; ++k)
        for_each_face_beyond(surface, point.face, corners[(k + 1) % 3], corners[(k + 2) % 3],
                             [&](uint32_t) { same.has_face_beyond[k] = true; });
    return same;
}

}

void require_same_mesh(const Index& index, const Surface& surface) {
    const Description& about = index.description;
    if (about.mesh_fingerprint != surface.fingerprint || about.id_count != surface.vertex_of_id.size() ||
        about.triangle_count != surface.face_of_triangle.size())
        throw Error(GEOIDX_ERROR_MESH_MISMATCH, "the surface is of another mesh than the index");
    if (surface.vertex_count() != index.vertices_with_id)
        refuse_argument("the surface has " + std::to_string(surface.vertex_count()) +
                        " different vertices, the index " + std::to_string(index.vertices_with_id) +
                        ": they differ in weld_tolerance");
}

uint32_t vertex_at(const Surface& surface, const SurfacePoint& point) {
    for (size_t k = 0; k < 3; ++k)
        if (point.weights[k] == 1) return surface.faces[point.face][k];
    return NONE;
}

FacePoint face_point_on(const Index& index, const Surface& surface, const SurfacePoint& point, bool unfolds,
                        double cost) {
    const auto [corners, weights, crosses] =
        unfolds ? unfolded_point(surface, point)
                : FlatFaces::Point{surface.faces[point.face], point.weights, {}};
    std::array<uint32_t, 3> numbers;
    std::array<double, 3> lengths;
    for (size_t k = 0; k < 3; ++k) {
        const uint32_t a = corners[(k + 1) % 3], b = corners[(k + 2) % 3];
        numbers[k] = number_of(index, surface, corners[k]);
        lengths[k] = cost * (surface.positions[a] - surface.positions[b]).norm();
    }
    if (std::ranges::find(numbers, NONE) != numbers.end())
        refuse_argument("the surface has a triangle that the index does not: they differ in weld_tolerance");
    return face_point(numbers, lengths, weights, crosses);
}

}
