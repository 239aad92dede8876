#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/mesh_io/triangle_mesh.h"
#include "tools/picture/vector.h"

namespace geodesic::tools {

// A mesh made ready to be drawn: moved and scaled into the unit ball around the centre of its bounding box.
struct DrawnSurface {
    std::vector<Vec3> positions;
    std::vector<std::array<uint32_t, 3>> triangles;
    std::vector<std::array<Vec3, 3>> normals; // of each triangle's corners: smooth, but for sharp creases
};

// Throws std::runtime_error for a position that is not finite.
DrawnSurface drawn_surface(const TriangleMesh& mesh);

// For each vertex the first one in the same place: seams of a mesh must not show in the picture.
std::vector<uint32_t> first_in_same_place(std::span<const Vec3> positions);

}
