#pragma once

#include <vector>

#include "src/path/path.h"

namespace geodesic {

// The next piece of a way to a target: both points lie in one face.
struct Step {
    SurfacePoint from, to;
    double distance; // of the target from the first point
};

// Where steps lead, and what is left of the path that they follow: a path in a strip or, where the metric
// does not unfold, its points.
struct Walk {
    SurfacePoint target;
    StraightPath left{};
    std::vector<SurfacePoint> points{};
};

// Finds the next step of whoever walks to a target and asks on the way, wherever it is. At a point of the
// kept path, the path is left as it is. At any other point of a face of its strip it is made straight again
// from there. Anywhere else a new path is found. Throws Error as find_path does.
Step next_step(const Index& index, Query& query, const Surface& surface, const SurfacePoint& from,
               Walk& walk);

}
