#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/mesh/mesh.h"

namespace geodesic {

// Returns the vertices of some faces in ascending order, each once.
std::vector<uint32_t> vertices_of(const Mesh& mesh, std::span<const uint32_t> faces);

// Returns the border rings of a patch. They are the connected chains of edges that bound the patch, without
// those chains that consist of boundary edges of the mesh only: some edge of a border ring has another patch
// on its other side. `inside[f]` tells whether face f is in the patch.
uint32_t count_border_rings(const Mesh& mesh, std::span<const uint32_t> faces,
                            const std::vector<uint8_t>& inside);

// Splits faces into groups that are connected over edges. Faces of different labels are in different groups;
// `label` has an entry for each face of the span. Groups are numbered in the order in which they first
// appear.
struct Components {
    std::vector<uint32_t> of_face; // the group of each face of the span
    uint32_t count = 0;
};
Components connected_components(const Mesh& mesh, std::span<const uint32_t> faces,
                                std::span<const uint32_t> label);

}
