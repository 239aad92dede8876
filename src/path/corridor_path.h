#pragma once

#include "src/path/corridor.h"

namespace geodesic {

// Makes the path of a strip shorter, if it is not as short as any in the corridor, by distances of window
// propagation, and straight on the whole surface: as short as any, or nearly always, which takes less time.
enum class Effort { NEARLY_ALWAYS, ALWAYS };
void make_shortest_in_corridor(const Surface& surface, const Corridor& corridor, Effort effort, Strip& strip,
                               StripPath& path);

// How long a shortest path between the ends of a strip is in the corridor.
double shortest_length_in_corridor(const Corridor& corridor, const Strip& strip);

}
