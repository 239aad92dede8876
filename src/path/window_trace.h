#pragma once

#include <optional>

#include "src/metric/window_propagation.h"
#include "src/path/strip.h"

namespace geodesic {

// The strip of a shortest path from a target point of the solver's latest solve to its only source, a point,
// led back over windows (Mitchell, Mount, Papadimitriou 1987): to a place in a face the path comes from the
// source, from a corner or over a window on an edge, whichever makes it shortest. It begins at the target;
// vertices and faces are those of the metric's mesh. Nothing if the target was not reached, or where rounding
// leads the path in a circle, as it may do in slivers.
std::optional<Strip> trace_back(const IntrinsicMesh& mesh, const WindowSolver& solver,
                                const SurfacePoint& target, const SurfacePoint& source);

}
