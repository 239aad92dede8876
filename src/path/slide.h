#pragma once

#include "src/path/strip.h"

namespace geodesic {

// The sum of the pieces' lengths, each times the cost of its face.
double weighted_length(const Surface& surface, const Strip& strip, const std::vector<double>& shares);

// Slides the points where a path passes the portals of its strip until its weighted length, which is convex
// in them, is least: projected Newton steps on a smoothed length, ever less smoothed. Never makes it longer.
void slide(const Surface& surface, const Strip& strip, StripPath& path);

}
