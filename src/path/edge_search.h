#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "src/surface/surface.h"

namespace geodesic {

// A vertex that a way begins or ends at, and how far it is from the end of the path.
struct VertexEnd {
    uint32_t vertex;
    double distance;
};

// A way over edges alone, by A*: its vertices, from one of the sources to one of the targets. Edges of
// infinite length are not passed.
std::optional<std::vector<uint32_t>>
search_edges(const Surface& surface, std::span<const VertexEnd> sources, std::span<const VertexEnd> targets,
             const std::function<double(uint32_t)>& distance_to_target,
             const std::function<double(uint32_t, uint32_t)>& edge_length);

}
