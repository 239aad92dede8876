#pragma once

#include <functional>
#include <optional>

#include "src/path/strip.h"

namespace geodesic {

// The strip from one point to another whose edges have the least sum of excesses. The excess of an edge is
// the length of the shortest path that crosses it less that of the shortest of all paths: 0 on a shortest
// path, infinite where no path is to cross it. Nothing if there is no such strip.
std::optional<Strip> strip_of_least_excess(const Surface& surface, const SurfacePoint& source,
                                           const SurfacePoint& target,
                                           const std::function<double(uint32_t, uint32_t)>& excess);

}
