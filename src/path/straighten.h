#pragma once

#include "src/path/strip.h"
#include "src/path/turn.h"

namespace geodesic {

// A strip has a vertex at its side or passes it: portals `first` to `last` all contain it.
struct Pass {
    size_t first, last;
    uint32_t vertex;
};

// The strip with the faces of a fan around that vertex in the place of its own between the portals.
Strip with_fan(const Strip& strip, const Pass& pass, const Turn::Fan& fan);

// Makes the path in a strip locally shortest: while it bends at a vertex whose other side has an angle of
// less than pi, the strip is turned around that vertex (Xin and Wang 2007). Each turn makes the path shorter.
// Where turns do not bring it below `limit`, the path is returned as it is then, not locally shortest.
StripPath straighten(const Surface& surface, Strip& strip, double limit = UNREACHABLE);

}
