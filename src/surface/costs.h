#pragma once

#include "geoidx.h"
#include "src/surface/surface.h"

namespace geodesic {

// The costs that options give, whose fields are all set, for the faces and edges of the mesh that was taken
// in. Throws Error INVALID_ARGUMENT that names what is wrong with them.
SurfaceCosts surface_costs(const Intake& intake, const geoidx_surface_options& options);

// The cost that is given for an edge between two vertices, or else its length.
double edge_cost(const Surface& surface, uint32_t a, uint32_t b);

// The face at the edge between two vertices of a face in which a way along the edge costs least.
uint32_t cheapest_face_at(const Surface& surface, uint32_t face, uint32_t a, uint32_t b);

}
