#pragma once

#include <cstdint>

#include "src/query/index.h"
#include "src/surface/indexed_faces.h"

namespace geodesic {

// The leaf of an index of the overlay engine that a face lies in. Where it cannot be told, as by a metric
// that does not unfold, whose borders have no segments, one that has all three corners inside of it or on its
// border; and NONE if there is none: where pruning has taken corners from borders there may be none. The
// index knows all corners.
uint32_t leaf_of_face(const Index& index, const Surface& surface, const AnyFace& face);

}
