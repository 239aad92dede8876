#pragma once

#include <functional>
#include <optional>

#include "src/path/strip.h"

namespace geodesic {

// A strip from one point to another that crosses edges of the least excess in all: excess(a, b) is by how
// much the shortest way over a point of an edge is longer than the shortest of all, infinite where no way is
// to cross it. Nothing if there is no such strip.
std::optional<Strip> strip_of_least_excess(const Surface& surface, const SurfacePoint& source,
                                           const SurfacePoint& target,
                                           const std::function<double(uint32_t, uint32_t)>& excess);

}
