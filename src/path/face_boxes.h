#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/path/surface.h"

namespace geodesic {

// The point of a face that is nearest to a point in space.
struct ClosestPoint {
    SurfacePoint point;
    double distance;
};

// Boxes around groups of faces that lie near each other, and around pairs of boxes, up to one around all:
// which faces may be the nearest is told by the boxes. The boxes are of floats, rounded outwards; faces are
// measured in double precision.
class FaceBoxes {
public:
    explicit FaceBoxes(const Surface& surface);

    // The position must be finite.
    ClosestPoint closest(const Surface& surface, const Eigen::Vector3d& position) const;

private:
    static constexpr uint32_t FACES_PER_LEAF = 8;
    struct Box {
        std::array<float, 3> low, high;
    };

    Box box_of_leaf(const Surface& surface, uint32_t leaf) const;
    double square_to(uint32_t box, const Eigen::Vector3d& position) const;
    void search_leaf(const Surface& surface, uint32_t leaf, const Eigen::Vector3d& position,
                     ClosestPoint& best) const;

    std::vector<uint32_t> order_; // the faces, neighbours in space one after the other
    uint32_t first_leaf_ = 0;
    std::vector<Box> boxes_; // a heap: box i is around 2 i + 1 and 2 i + 2
};

// The point of a face that is nearest to a position.
SurfacePoint closest_on_face(const Surface& surface, uint32_t face, const Eigen::Vector3d& position);

}
