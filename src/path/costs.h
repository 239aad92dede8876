#pragma once

#include "geoidx.h"
#include "src/path/surface.h"
#include "src/query/index.h"

namespace geodesic {

// The costs that options give, whose fields are all set, for the faces and edges of the mesh that was taken
// in. Throws Error INVALID_ARGUMENT that names what is wrong with them.
SurfaceCosts surface_costs(const Intake& intake, const geoidx_surface_options& options);

// The cost that is given for an edge between two vertices, or else its length.
double edge_cost(const Surface& surface, uint32_t a, uint32_t b);

// The face at the edge between two vertices of a face in which a way along the edge costs least.
uint32_t cheapest_face_at(const Surface& surface, uint32_t face, uint32_t a, uint32_t b);

// Throw Error INVALID_ARGUMENT unless the surface has the costs that an index by edge costs, or by those of
// faces, was built with.
void require_edge_costs(const Index& index, const Surface& surface);
void require_face_costs(const Index& index, const Surface& surface);

}
