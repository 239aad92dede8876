#pragma once

#include <array>
#include <span>
#include <vector>

#include "src/metric/intrinsic_mesh.h"
#include "src/metric/metric.h"

namespace geodesic {

// A point of a face in the plane of one of its sides (see Side): at (x, -depth).
struct PlanePoint {
    double x, depth;
};

// The point in the plane of the side opposite to `corner` of its face.
PlanePoint place_on_side(const IntrinsicMesh& mesh, uint32_t corner, const SurfacePoint& point);

// The point as a point of every face that it lies on the border of, or of its only one.
std::vector<SurfacePoint> in_all_faces(const IntrinsicMesh& mesh, const SurfacePoint& point);

// A point on the border of faces is there once for each.
struct TargetPoint {
    uint32_t face;
    uint32_t index;                    // in the request
    std::array<PlanePoint, 3> on_side; // opposite to each corner of the face
};

// The target points of a solve, found by their face.
class TargetPoints {
public:
    void place(const IntrinsicMesh& mesh, std::span<const SurfacePoint> points);
    bool empty() const { return points_.empty(); }
    std::span<const TargetPoint> of_face(uint32_t face) const;

private:
    std::vector<TargetPoint> points_; // by face
};

}
