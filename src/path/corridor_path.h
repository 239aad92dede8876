#pragma once

#include "src/path/corridor.h"

namespace geodesic {

// How often a path comes out as short as any in the corridor; nearly always takes less time.
enum class Effort { NEARLY_ALWAYS, ALWAYS };

// Makes the path of a strip as short as any in the corridor, by distances of window propagation, and straight
// on the whole surface. Returns at once if it is that short.
void make_shortest_in_corridor(const Surface& surface, const Corridor& corridor, Effort effort, Strip& strip,
                               StripPath& path);

// How long a shortest path between the ends of a strip is in the corridor.
double shortest_length_in_corridor(const Corridor& corridor, const Strip& strip);

}
