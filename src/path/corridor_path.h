#pragma once

#include "src/path/corridor.h"

namespace geodesic {

// Makes the path of a strip as short as any in the corridor, by distances of window propagation, and straight
// on the whole surface. Returns at once if it is that short.
void make_shortest_in_corridor(const Surface& surface, const Corridor& corridor, Strip& strip,
                               StripPath& path);

}
