#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "src/surface/surface.h"

namespace geodesic {

// The point of a face that is nearest to a point in space.
struct ClosestPoint {
    SurfacePoint point;
    double distance;
};

// Boxes around runs of faces, which lie near each other since faces are numbered in spatial order, and around
// pairs of boxes, up to one around all: which faces may be the nearest is told by the boxes. A box is told by
// steps across the one around it, rounded outwards, so that it fits what lies in it however wide the surface
// is; faces are measured in double precision.
class FaceBoxes {
public:
    explicit FaceBoxes(const Surface& surface);

    // The position must be finite.
    ClosestPoint closest(const Surface& surface, const Eigen::Vector3d& position) const;

private:
    struct Box {
        std::array<uint16_t, 3> low, high; // steps from either end of the box around it
    };
    struct Nearest;

    static Box inside_of(const Eigen::AlignedBox3d& around, const Eigen::AlignedBox3d& exact);
    static Eigen::AlignedBox3d place(const Eigen::AlignedBox3d& around, const Box& box);
    uint32_t first_face_of(const Surface& surface, uint32_t leaf) const;
    Eigen::AlignedBox3d around_leaf(const Surface& surface, uint32_t leaf) const;
    void search_leaf(const Surface& surface, uint32_t leaf, const Eigen::Vector3d& position,
                     Nearest& best) const;

    Eigen::AlignedBox3d whole_;
    uint32_t first_leaf_ = 0;
    std::vector<Box> boxes_; // a heap: box i is around 2 i + 1 and 2 i + 2; the first one is not read
};

// The point of a face that is nearest to a position.
SurfacePoint closest_on_face(const Surface& surface, uint32_t face, const Eigen::Vector3d& position);

}
