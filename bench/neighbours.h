#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/mesh_io/triangle_mesh.h"

namespace geodesic::bench {

// Which vertices of a mesh an edge joins.
class Neighbours {
public:
    explicit Neighbours(size_t vertex_count) : of_(vertex_count) {}
    explicit Neighbours(const tools::TriangleMesh& mesh);

    // Adds an edge. Returns false if it is there.
    bool add(uint32_t a, uint32_t b);

    // The vertices so many edges from a vertex, the nearest first; no more than `most` of them.
    std::vector<uint32_t> around(uint32_t center, uint32_t fewest_edges, uint32_t most_edges,
                                 size_t most = SIZE_MAX) const;

private:
    std::vector<std::vector<uint32_t>> of_;
};

// Calls use(a, b) for each side of each triangle.
template <class Use>
void for_each_side(const tools::TriangleMesh& mesh, const Use& use) {
    for (size_t i = 0; i < mesh.triangles.size(); ++i)
        use(mesh.triangles[i], mesh.triangles[i % 3 == 2 ? i - 2 : i + 1]);
}

}
