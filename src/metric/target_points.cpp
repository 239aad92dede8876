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

std::vector<SurfacePoint> in_all_faces(const IntrinsicMesh& mesh, const SurfacePoint& point) {
    const uint32_t first = 3 * point.face;
    std::vector<SurfacePoint> aliases;
    for (uint32_t k = 0; k < 3; ++k) {
        if (point.weights[k] != 1) continue;
        for (uint32_t corner : mesh.corners[corner_vertex(mesh, first + k)]) {
            aliases.push_back({corner / 3, {}});
            aliases.back().weights[corner % 3] = 1;
        }
        return aliases;
    }
    for (uint32_t k = 0; k < 3; ++k) {
        if (point.weights[k] != 0) continue;
        for (const Side& side : mesh.sides[mesh.edge_of_corner[first + k]]) {
            aliases.push_back({side.face, {}});
            for (uint32_t other = 0; other < 3; ++other)
                for (uint32_t own = 0; own < 3; ++own)
                    if (own != k &&
                        corner_vertex(mesh, 3 * side.face + other) == corner_vertex(mesh, first + own))
                        aliases.back().weights[other] = point.weights[own];
        }
        return aliases;
    }
    return {point};
}

void TargetPoints::place(const IntrinsicMesh& mesh, std::span<const SurfacePoint> points) {
    points_.clear();
    for (uint32_t i = 0; i < points.size(); ++i) {
        for (const SurfacePoint& alias : in_all_faces(mesh, points[i])) {
            TargetPoint& target = points_.emplace_back(TargetPoint{alias.face, i, {}});
            for (uint32_t k = 0; k < 3; ++k)
                target.on_side[k] = place_on_side(mesh, 3 * alias.face + k, alias);
        }
    }
    std::ranges::stable_sort(points_, {}, &TargetPoint::face);
}

std::span<const TargetPoint> TargetPoints::of_face(uint32_t face) const {
    const auto begin = std::ranges::lower_bound(points_, face, {}, &TargetPoint::face);
    const auto end = std::ranges::upper_bound(points_, face, {}, &TargetPoint::face);
    return {begin, end};
}

}
