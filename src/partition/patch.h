#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/mesh/mesh.h"

namespace geodesic {

// The vertices of some faces, ascending, each once.
std::vector<uint32_t> vertices_of(const Mesh& mesh, std::span<const uint32_t> faces);

// The border rings of a patch: the connected chains of edges that bound it, as far as another patch lies
// beyond some edge of the chain. A loop of the mesh's own boundary alone is no border ring. `inside[f]` tells
// whether face f is in the patch.
uint32_t count_border_rings(const Mesh& mesh, std::span<const uint32_t> faces,
                            const std::vector<uint8_t>& inside);

// Splits faces into groups that hang together over edges: group number per face, numbered by first
// appearance; faces of different `label` (per face of the span) are in different groups.
struct Components {
    std::vector<uint32_t> of_face; // parallel to the span
    uint32_t count = 0;
};
Components connected_components(const Mesh& mesh, std::span<const uint32_t> faces,
                                std::span<const uint32_t> label);

}
