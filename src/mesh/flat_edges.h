#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "src/mesh/mesh.h"

namespace geodesic {

// A mesh in which edges of another mesh are flipped. It has the same vertices, and as many faces and edges.
struct FlippedEdges {
    Mesh mesh;
    // Per face the number of its plane: of what is connected over edges that are flat one by one. The faces
    // of a plane cover the same part of the surface in both meshes. NONE where nothing is flipped in the
    // plane.
    std::vector<uint32_t> plane_of_face;
};

// Makes faces rounder without changing the surface: where two faces lie in one plane, their quadrangle may be
// cut along either diagonal, and flat edges are flipped until they are locally Delaunay; of diagonals of four
// corners on a circle, the one that is shorter by a tenth is taken, too. Programs that cut
// faces with holes or many corners into triangles leave slivers as long as the face; borders of patches along
// these have long segments, and exact paths cross many of them. Planes whose edges would hardly become
// shorter stay as they are, and so do an edge of more or fewer than two faces, and one whose other diagonal
// is, or was, another edge. Two faces lie in one plane if no distance over their edge changes by more than
// 1e-7 of it. After 50 times as many flips as there
// are edges, the others stay as they are. Nothing if no edge is flipped.
std::optional<FlippedEdges> flip_flat_edges(const Mesh& mesh);

}
