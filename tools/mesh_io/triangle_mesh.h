#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace geodesic::tools {

// A mesh as its file has it: every vertex in the file's order, polygons divided into triangles, in the file's
// order.
struct TriangleMesh {
    std::vector<double> positions;   // x, y, z of each vertex
    std::vector<uint32_t> triangles; // three vertex ids a triangle

    size_t vertex_count() const { return positions.size() / 3; }
    size_t triangle_count() const { return triangles.size() / 3; }
};

}
