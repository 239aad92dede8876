#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "src/mesh/mesh.h"

namespace geodesic {

// The `count` vertices that are the fewest edges away from some others, which come first, each once. Fewer
// where no more are joined to these. A vertex may have any number of neighbours.
std::vector<uint32_t> nearest_by_edges(const Mesh& mesh, std::span<const uint32_t> from, size_t count);

}
