#pragma once

#include "src/path/strip.h"
#include "src/path/surface_path.h"
#include "src/query/query.h"

namespace geodesic {

// The next piece of a way to a target: both points lie in one face.
struct Step {
    SurfacePoint from, to;
    double distance; // of the target from the first point
};

// Where steps lead, and what is left of the path that they follow: by the exact metric a path in a strip, by
// others the path itself, as it was found.
struct Walk {
    SurfacePoint target;
    StripWay left{};
    SurfacePath found{};
};

// Finds the next step of whoever walks to a target and asks on the way, wherever it is. At a point of the
// kept path, the path is left as it is; of one over vertices, only these count as its points. By the
// exact metric, at any other point of a face of its strip it is made straight again from there, unless the
// index knows a shorter way. Anywhere else a new path is found. Throws Error as find_path does.
Step next_step(const Index& index, Query& query, const Surface& surface, const SurfacePoint& from,
               Walk& walk);

}
