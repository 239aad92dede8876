#pragma once

#include <unordered_map>

#include "geoidx.h"
#include "src/mesh/mesh.h"

namespace geodesic {

// The caller's mesh after checking, welding and clean-up.
struct Intake {
    Mesh mesh;
    std::vector<uint32_t>
        vertex_of_id; // per caller's id: its vertex in `mesh`, NONE where no triangle uses it
    std::vector<uint32_t> id_of_vertex; // per vertex of `mesh`: the first caller's id welded into it
    std::vector<uint32_t>
        face_of_triangle; // per triangle of the caller's, NONE where it was dropped as degenerate
    // Of the triangles that repeat another: the corner of the face that each of their corners is.
    std::unordered_map<uint32_t, std::array<uint32_t, 3>> corners_of_duplicate;
    uint64_t fingerprint = 0;
    double bounding_box_diagonal = 0; // of the used vertices
};

struct IntakeOptions {
    double weld_tolerance = 0;
    bool refuse_edges_of_many = false; // of more than two triangles
};

// Checks the caller's mesh and makes a clean one of it; throws Error naming the first offending element.
Intake take_in(const geoidx_mesh& mesh, const IntakeOptions& options);

// The same where it is known which vertices are one: representative[id] is the lowest id of those that `id`
// is one with, and for the ids that no triangle uses, one of them.
Intake take_in_welded(const geoidx_mesh& mesh, const std::vector<uint32_t>& representative);

// Tells one mesh from another by its numbers: positions, rounded to float, and triangles in the caller's
// order. Throws Error where the arrays cannot be read.
uint64_t mesh_fingerprint(const geoidx_mesh& mesh);

// Bytes from one position to the next.
size_t position_stride(const geoidx_mesh& mesh);

// Per caller's id. Throws Error BAD_MESH for a position that is not finite or too large for a float.
std::vector<Eigen::Vector3d> positions_of(const geoidx_mesh& mesh);

}
