#pragma once

#include <cstdint>

#include "src/query/index.h"
#include "src/surface/surface.h"

namespace geodesic {

// A face that an index was made on, or one of the surface (see indexed_faces.h).
struct AnyFace {
    bool is_of_index;
    uint32_t face;
};
std::array<uint32_t, 3> corners_of(const Surface& surface, const AnyFace& face);

// Whether another such face shares the edge between two corners of a face.
bool has_face_beyond(const Surface& surface, const AnyFace& face, uint32_t a, uint32_t b);

// The leaf of an index of the overlay engine that a face lies in. Where it cannot be told, one that has all
// three corners inside of it or on its border, and NONE if there is none: where pruning has taken corners
// from borders there may be none. The index knows all corners.
uint32_t leaf_of_face(const Index& index, const Surface& surface, const AnyFace& face);

}
