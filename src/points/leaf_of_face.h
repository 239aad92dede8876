#pragma once

#include <cstdint>

#include "src/query/index.h"
#include "src/surface/indexed_faces.h"

namespace geodesic {

// The leaf of an index of the overlay engine that a face lies in. The index must know all corners of the
// face. If the metric does not unfold, borders have no segments that tell on which side of them a face lies:
// then any leaf that has all three corners inside of it or on its border. NONE if no leaf has, as may be
// where pruning has taken corners from borders.
uint32_t leaf_of_face(const Index& index, const Surface& surface, const AnyFace& face);

}
