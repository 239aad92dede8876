#pragma once

#include "geoidx.h"
#include "src/mesh/mesh.h"

namespace geodesic {

// The caller's mesh after checking, welding and clean-up.
struct Intake {
    Mesh mesh;
    std::vector<uint32_t>
        vertex_of_id; // per caller's id: its vertex in `mesh`, NONE where no triangle uses it
    std::vector<uint32_t> id_of_vertex; // per vertex of `mesh`: the first caller's id welded into it
    uint64_t triangle_count = 0;        // of the caller's array
    uint64_t fingerprint = 0;
    double bounding_box_diagonal = 0; // of the used vertices
};

// Checks the caller's mesh and makes a clean one of it; throws Error naming the first offending element.
Intake take_in(const geoidx_mesh& mesh, double weld_tolerance);

// Tells one mesh from another by its numbers: positions (as doubles) and triangles in the caller's order.
// Throws Error where the arrays cannot be read.
uint64_t mesh_fingerprint(const geoidx_mesh& mesh);

}
