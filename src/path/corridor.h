#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "src/mesh/mesh.h"
#include "src/path/strip.h"

namespace geodesic {

// A part of a surface as a mesh of its own. It contains both ends of the strip that it was made for.
struct Corridor {
    Mesh mesh;
    // Per face of the mesh: the face of the surface that it is, with the same order of corners.
    std::vector<uint32_t> surface_face;
};

// The vertices that are joined to those of a strip by edges between vertices that belong to it, and all faces
// around them. belongs(vertex, slack) is asked with the length of the longest edge at the vertex: once at
// most, and not of the vertices of the strip.
Corridor corridor_around(const Surface& surface, const Strip& strip,
                         const std::function<bool(uint32_t, double)>& belongs);

// All faces that a path of this length between the ends of a strip can lead over, by their distances from
// both ends in space. Nothing if these are more than `most_faces`, or if very many lie around them.
std::optional<Corridor> corridor_in_space(const Surface& surface, const Strip& strip, double length,
                                          size_t most_faces);

}
