#pragma once

#include <cstdint>
#include <memory_resource>

#include "src/index/face_point.h"
#include "src/overlay/tables.h"

namespace geodesic {

// What a point of a face is to a sweep: the distances to the border and to the internal vertices of a leaf,
// as if it were an internal vertex of that leaf itself.
struct PointWays {
    explicit PointWays(std::pmr::memory_resource* memory) : distance(memory) {}

    uint32_t leaf = NONE;
    Array<float> distance; // border vertices in the order of the border, then internal vertices
};

// A leaf with all three corners inside of it or on its border, or NONE: where added vertices have cut a face,
// or pruning has taken corners from borders, there may be none.
uint32_t leaf_of_face(const Numbering& numbering, const std::array<uint32_t, 3>& corners);

// Whether a vertex is inside of a leaf or on its border.
bool is_in_leaf(const Numbering& numbering, uint32_t leaf, uint32_t number);

// The distance of two such vertices, by the tables.
float distance_in_leaf(const OverlayIndex& index, uint32_t leaf, uint32_t a, uint32_t b);

// The distance of a point from such a vertex.
float distance_in_leaf(const OverlayIndex& index, uint32_t leaf, const FacePoint& point, uint32_t number);

// Fills the distances of a point from the border of its leaf, in the order of the border.
void fill_border_ways(const OverlayIndex& index, uint32_t leaf, const FacePoint& point,
                      Array<float>& distances);

// Fills the ways of a point from the tables of its leaf, with `offset` added to each.
void fill_ways(const OverlayIndex& index, uint32_t leaf, const FacePoint& point, float offset,
               PointWays& ways);

// The row of a point to the ring of its leaf, as the inner table has it for vertices, but in steps of its
// own: the tables of the leaf may hold no distance that is as long, or none at all.
struct PointRow {
    explicit PointRow(std::pmr::memory_resource* memory) : distances(memory), codes(memory) {}

    float quantum = 0;
    Array<float> distances; // scratch: by position in the border
    Array<uint16_t> codes;
};
void fill_row(const OverlayIndex& index, uint32_t leaf, const FacePoint& point, PointRow& row);

}
