#pragma once

#include "src/path/strip.h"

namespace geodesic {

// Leads a path of least weighted length in its strip through other faces where that makes it shorter: on
// another side around a vertex that it passes, along an edge through a cheaper face beside it, or straight on
// instead of through such a face. No change makes the path longer, and there is a bounded number of them;
// the path is then least in its new strip.
void try_detours(const Surface& surface, StripWay& way);

}
