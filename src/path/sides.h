#pragma once

#include <span>

#include "src/path/strip.h"

namespace geodesic {

// A path that is straight beside a vertex of less than the full angle may be as straight, and shorter, on the
// other side of it. Tries the other sides of vertices along each strip as long as that helps, and leaves the
// paths locally shortest, as they are given.
void try_other_sides(const Surface& surface, std::span<StripWay> ways);

}
