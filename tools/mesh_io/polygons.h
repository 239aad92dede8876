#pragma once

#include <span>
#include <string>
#include <vector>

#include "tools/mesh_io/triangle_mesh.h"

namespace geodesic::tools {

// Vertex ids end before the number that the library keeps for itself.
inline constexpr uint64_t MAX_VERTICES = 0xFFFFFFFEu;

// The faces of a file, each with its corners in order; fewer than three corners are no face.
struct Polygons {
    std::vector<uint32_t> corners;
    std::vector<size_t> ends; // one past the last corner of each face

    void add(std::span<const uint32_t> polygon);
    bool empty() const { return ends.empty(); }
};

// Divides polygons into triangles, in order. A convex one is cut into halves, and each half again, so that no
// corner has many triangles; four corners become 0 1 2, 0 2 3. Of one with reflex corners the triangles lie
// inside, seen along its mean normal. Corners are valid ids of the positions (x, y, z of each vertex).
std::vector<uint32_t> triangulate(const Polygons& polygons, std::span<const double> positions);

// "vertex index 9 is out of range, the mesh has 8 vertices"
std::string out_of_range(const std::string& index, uint64_t vertex_count);

}
