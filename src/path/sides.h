#pragma once

#include "src/path/strip.h"

namespace geodesic {

// A path that is straight beside a vertex of less than the full angle may be as straight, and shorter, on the
// other side of it. Tries the other sides of vertices along the strip as long as that helps, and leaves the
// path locally shortest, as it is given.
void try_other_sides(const Surface& surface, StripWay& way);

}
