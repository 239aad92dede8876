#pragma once

#include "src/path/strip.h"

namespace geodesic {

// Makes the path in a strip locally shortest: while it bends at a vertex whose other side has an angle of
// less than pi, the strip is turned around that vertex (Xin and Wang 2007). Each turn makes the path shorter.
StripPath straighten(const Surface& surface, Strip& strip);

}
