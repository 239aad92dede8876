#pragma once

#include "tests/campaign/dice.h"

namespace geodesic::campaign {

// One to five random shapes side by side, into each other or far apart, of sizes that differ little or very
// much; then duplicate, degenerate and flipped triangles, seams, unused vertices, another unit, another
// place, other ids.
test::Soup random_mesh(Dice& dice);

}
