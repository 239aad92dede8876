#pragma once

#include "src/path/corridor.h"

namespace geodesic {

// Makes the path of a strip as short as any in the corridor, and straight on the whole surface: window
// propagation tells how long a shortest one is, and its windows lead back along it. The path stays as it is
// if it is that short, or if rounding hides the way back.
void make_shortest_in_corridor(const Surface& surface, const Corridor& corridor, Strip& strip,
                               StripPath& path);

// How long a shortest path between the ends of a strip is in the corridor.
double shortest_length_in_corridor(const Corridor& corridor, const Strip& strip);

}
