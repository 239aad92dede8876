#pragma once

#include <optional>

#include "src/mesh/mesh.h"

namespace geodesic {

// The same surface with rounder faces: where two faces lie in one plane, their quadrangle may be cut along
// either diagonal, and edges are flipped until all flat edges are locally Delaunay. Programs that cut faces
// with holes or many corners into triangles leave slivers as long as the face; borders of patches along these
// have long segments, and exact paths cross many of them. Vertices stay as they are, and distances do to 1e-8
// of the distance. An edge of more or fewer than two faces stays, and so does one whose other diagonal is an
// edge already. Nothing if no edge is to be flipped.
std::optional<Mesh> flip_flat_edges(const Mesh& mesh);

}
