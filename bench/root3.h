#pragma once

#include "tools/mesh_io/triangle_mesh.h"

namespace geodesic::bench {

// One step of root-3 subdivision (Kobbelt 2000): a vertex in the middle of each triangle, edges of two
// triangles flipped, old vertices smoothed. Three triangles for each; edges of one triangle, or of more than
// two, and their vertices stay.
tools::TriangleMesh root3_subdivided(const tools::TriangleMesh& mesh);

}
