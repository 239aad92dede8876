#include "src/metric/target_points.h"

#include <algorithm>

namespace geodesic {

PlanePoint place_on_side(const IntrinsicMesh& mesh, uint32_t corner, const SurfacePoint& point) {
    const Side& side = mesh.sides.items[mesh.side_of_corner[corner]];
    const uint32_t apex = corner % 3, begin = corner - apex;
    // The edge from the side's first vertex to the apex is opposite to its second vertex.
    const bool next_is_second = mesh.edge_of_corner[begin + (apex + 1) % 3] == side.tagged_edge[0] >> 1;
    const uint32_t second = (apex + (next_is_second ? 1 : 2)) % 3;
    const double length = mesh.edge_length[mesh.edge_of_corner[corner]];
    return {point.weights[second] * length + point.weights[apex] * side.apex_x,
            point.weights[apex] * side.apex_depth};
}

void TargetPoints::place(const IntrinsicMesh& mesh, std::span<const SurfacePoint> points) {
    points_.clear();
    for (uint32_t i = 0; i < points.size(); ++i) {
        TargetPoint& target = points_.emplace_back(TargetPoint{points[i].face, i, {}});
        for (uint32_t k = 0; k < 3; ++k)
            target.on_side[k] = place_on_side(mesh, 3 * points[i].face + k, points[i]);
    }
    std::ranges::stable_sort(points_, {}, &TargetPoint::face);
}

std::span<const TargetPoint> TargetPoints::of_face(uint32_t face) const {
    const auto found = std::ranges::equal_range(points_, face, {}, &TargetPoint::face);
    return {found.begin(), found.end()};
}

}
