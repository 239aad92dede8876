#pragma once

#include <functional>
#include <optional>

#include "src/path/strip.h"

namespace geodesic {

// A part of a surface: the faces around some of its vertices.
struct Corridor {
    Mesh mesh;
    std::vector<uint32_t> face_of_surface; // per face of the mesh
};

// The vertices that are joined to those of a strip by edges between vertices that belong to it, and all faces
// around them. belongs(vertex, slack) is asked with the length of the longest edge at the vertex.
Corridor corridor_around(const Surface& surface, const Strip& strip,
                         const std::function<bool(uint32_t, double)>& belongs);

// All faces that a path of this length between the ends of a strip can lead over, by their distances from
// both ends in space. Nothing if these are more than `most_faces`, or if very many lie around them.
std::optional<Corridor> corridor_in_space(const Surface& surface, const Strip& strip, double length,
                                          size_t most_faces);

}
