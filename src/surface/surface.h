#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "src/mesh/components.h"
#include "src/mesh/intake.h"
#include "src/metric/metric.h"
#include "src/surface/flat_faces.h"
#include "src/surface/vertex_faces.h"

namespace geodesic {

// What a surface knows of costs; empty where none are given.
struct SurfaceCosts {
    std::vector<double> of_face;                         // per face: what a unit of length costs
    std::unordered_map<uint64_t, double> of_edge;        // of some edges, by edge_key() of the two vertices
    uint64_t face_fingerprint = 0, edge_fingerprint = 0; // as an index has them; 0 where there are none
    uint32_t points_per_edge = 0;                        // of the metric of `of_face`
};

// A clean mesh as paths need it: positions, faces, and the faces around each vertex. Faces that share an edge
// are found around one of its ends, however many there are. Vertices and faces are in spatial order, as
// Intake has them: in the caller's order, paths over scans take up to 17 % longer.
struct Surface {
    explicit Surface(Intake&& intake, SurfaceCosts&& costs = {}, FlatFaces&& flat = {});

    double average_edge; // each edge counts once, as for the stated errors by distance; first, since it needs
                         // the mesh whose arrays the others take
    Components components;
    std::vector<Eigen::Vector3d> positions;
    std::vector<std::array<uint32_t, 3>> faces;
    VertexFaces vertex_faces;
    std::vector<uint32_t> vertex_of_id;     // per caller's id; NONE where no triangle uses it
    std::vector<uint32_t> id_of_vertex;     // the first of the caller's ids
    std::vector<uint32_t> face_of_triangle; // per caller's triangle; NONE where it is degenerate
    std::vector<uint32_t> triangle_of_face; // the first of the caller's, with the same order of corners
    std::unordered_map<uint32_t, std::array<uint32_t, 3>> corners_of_duplicate; // as in Intake
    uint64_t fingerprint = 0;
    SurfaceCosts costs;
    FlatFaces flat_faces; // for distances of points by positions, whatever the costs

    uint32_t vertex_count() const { return static_cast<uint32_t>(positions.size()); }
    uint32_t face_count() const { return static_cast<uint32_t>(faces.size()); }
};

Eigen::Vector3d position_of(const Surface& surface, const SurfacePoint& point);

// The vertex that a point is at, or NONE.
uint32_t vertex_at(const Surface& surface, const SurfacePoint& point);

// Weights less than this count as 0, of points that callers give and of those that they get: what they get
// and give back is the same point, on the same edges and vertices.
inline constexpr double NEGLIGIBLE_WEIGHT = 1e-12;

// Weights that are not negative, scaled to 1 in sum, without those under NEGLIGIBLE_WEIGHT. Applied to what
// it returned, it changes no bit, so that a point that is given out and comes back is the same one.
std::array<double, 3> without_negligible(std::array<double, 3> weights);

// The corner of a face that a vertex is, or NONE.
inline uint32_t corner_of(const Surface& surface, uint32_t face, uint32_t vertex) {
    for (uint32_t k = 0; k < 3; ++k)
        if (surface.faces[face][k] == vertex) return k;
    return NONE;
}

inline bool has_corner(const Surface& surface, uint32_t face, uint32_t vertex) {
    const auto& [a, b, c] = surface.faces[face];
    return (a == vertex) | (b == vertex) | (c == vertex); // without jumps, which processors would mispredict
}

// A vertex as a point of one of its faces.
inline SurfacePoint corner_point(const Surface& surface, uint32_t face, uint32_t vertex) {
    SurfacePoint point{face, {}};
    point.weights[corner_of(surface, face, vertex)] = 1;
    return point;
}

// The corner of the face around a vertex that is the first one of the caller's.
SurfacePoint point_at_vertex(const Surface& surface, uint32_t vertex);

// Calls use(face) for every other face at the edge between two vertices of a face. There are fewer faces to
// look at around one end than around the hub of a wheel.
template <class Use>
void for_each_face_beyond(const Surface& surface, uint32_t face, uint32_t a, uint32_t b, const Use& use) {
    if (surface.vertex_faces.room_for(b) < surface.vertex_faces.room_for(a)) std::swap(a, b);
    for (const uint32_t other : surface.vertex_faces[a])
        if (other != face && has_corner(surface, other, b)) use(other);
}

}
