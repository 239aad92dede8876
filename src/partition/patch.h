#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/mesh/mesh.h"

namespace geodesic {

// Returns the vertices of some faces in ascending order, each once.
std::vector<uint32_t> vertices_of(const Mesh& mesh, std::span<const uint32_t> faces);

// Splits faces into groups that are connected over edges. Faces of different labels are in different groups;
// `label` has an entry for each face of the span. Groups are numbered in the order in which they first
// appear.
struct FaceGroups {
    std::vector<uint32_t> of_face; // the group of each face of the span
    uint32_t count = 0;
};
FaceGroups connected_groups(const Mesh& mesh, std::span<const uint32_t> faces,
                            std::span<const uint32_t> label);

}
