#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/surface/surface.h"

namespace geodesic {

// The point of a face that is nearest to a point in space.
struct ClosestPoint {
    SurfacePoint point;
    double distance;
};

// Boxes around runs of faces, which lie near each other since faces are numbered in spatial order, and around
// pairs of boxes, up to one around all: which faces may be the nearest is told by the boxes. Boxes are in
// whole cells of a grid over the surface and rounded outwards; faces are measured in double precision.
class FaceBoxes {
public:
    explicit FaceBoxes(const Surface& surface);

    // The position must be finite.
    ClosestPoint closest(const Surface& surface, const Eigen::Vector3d& position) const;

private:
    struct Box {
        std::array<uint16_t, 3> low, high;
    };

    Eigen::Vector3d in_cells(const Eigen::Vector3d& position) const;
    void add_to(Box& box, const Eigen::Vector3d& position) const;
    uint32_t first_face_of(const Surface& surface, uint32_t leaf) const;
    Box box_of_leaf(const Surface& surface, uint32_t leaf) const;
    double square_to(uint32_t box, const Eigen::Vector3d& cells) const;
    void search_leaf(const Surface& surface, uint32_t leaf, const Eigen::Vector3d& position,
                     ClosestPoint& best) const;

    Eigen::Vector3d origin_; // of the grid
    double cells_per_length_ = 0;
    uint32_t first_leaf_ = 0;
    std::vector<Box> boxes_; // a heap: box i is around 2 i + 1 and 2 i + 2
};

// The point of a face that is nearest to a position.
SurfacePoint closest_on_face(const Surface& surface, uint32_t face, const Eigen::Vector3d& position);

}
