#include "tests/campaign/surface_points.h"

#include <algorithm>
#include <cmath>

#include "tests/campaign/finding.h"
#include "tests/support/triangle_distance.h"

namespace geodesic::campaign {

std::string described(const geoidx_surface_point& point) {
    return formatted("(%u: %.17g %.17g %.17g)", point.triangle, point.weights[0], point.weights[1],
                     point.weights[2]);
}

bool is_same(const geoidx_surface_point& a, const geoidx_surface_point& b) {
    return a.triangle == b.triangle && std::ranges::equal(a.weights, b.weights);
}

SurfacePoints::SurfacePoints(const BuildInput& input) : input_(input), surface_(input.make_surface()) {
    for (const auto& triangle : input.surface().triangles())
        for (const uint32_t v : triangle.vertices)
            extent_ = std::max(extent_, input.position(v).lpNorm<Eigen::Infinity>());
}

geoidx_surface_point SurfacePoints::random_point(Dice& dice, bool is_at_vertex) const {
    const auto& triangles = input_.surface().triangles();
    geoidx_surface_point point{};
    point.triangle = triangles[dice.below(triangles.size())].number;
    const uint32_t corners = is_at_vertex ? 1 : dice.between(1, 3), first = dice.below(3);
    double left = 1;
    for (uint32_t k = 0; k + 1 < corners; ++k) {
        // Near a corner or an edge, too.
        const double share = dice.chance(0.2) ? std::pow(10.0, dice.real(-9, -1)) : dice.real(0.01, 0.99);
        point.weights[(first + k) % 3] = left * share;
        left -= point.weights[(first + k) % 3];
    }
    point.weights[(first + corners - 1) % 3] = left;
    return point;
}

uint32_t SurfacePoints::vertex_of(const geoidx_surface_point& point) const {
    for (size_t k = 0; k < 3; ++k)
        if (point.weights[k] == 1) return input_.mesh().triangles[3 * size_t{point.triangle} + k];
    return GEOIDX_NO_SOURCE;
}

std::array<uint32_t, 3> SurfacePoints::vertices(const geoidx_surface_point& point) const {
    const uint32_t* const ids = input_.mesh().triangles + 3 * size_t{point.triangle};
    return {ids[0], ids[1], ids[2]};
}

Eigen::Vector3d SurfacePoints::corner(uint32_t triangle, size_t k) const {
    return input_.position(
        input_.surface().representative(input_.mesh().triangles[3 * size_t{triangle} + k]));
}

Eigen::Vector3d SurfacePoints::position(const geoidx_surface_point& point) const {
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    for (size_t k = 0; k < 3; ++k) at += point.weights[k] * corner(point.triangle, k);
    return at;
}

bool SurfacePoints::are_joined(const geoidx_surface_point& a, const geoidx_surface_point& b) const {
    return input_.surface().are_joined(vertices(a)[0], vertices(b)[0]);
}

double SurfacePoints::cost_of_piece(const geoidx_surface_point& a, const geoidx_surface_point& b) const {
    double least = FAR;
    for (const auto& triangle : input_.surface().triangles())
        if (has_point(triangle.number, a) && has_point(triangle.number, b))
            least = std::min(least, input_.face_cost(triangle.number));
    return least;
}

std::vector<SurfacePoints::Corner> SurfacePoints::corners_from(const geoidx_surface_point& point) const {
    const auto ids = vertices(point);
    std::vector<Corner> corners;
    for (size_t k = 0; k < 3; ++k) {
        if (point.weights[k] == 1) return {{ids[k], 0}};
        const double straight = (position(point) - corner(point.triangle, k)).norm();
        geoidx_surface_point at{point.triangle, 0, {}};
        at.weights[k] = 1;
        corners.push_back({ids[k], cost_of_piece(point, at) * straight});
    }
    return corners;
}

std::vector<double> SurfacePoints::along_edges(const geoidx_surface_point& point) const {
    std::vector<double> least(input_.surface().vertex_count(), FAR);
    for (const auto& [vertex, straight] : corners_from(point)) {
        const auto field = input_.surface().along_edges(input_.edge_bounds(), vertex);
        for (uint32_t id = 0; id < least.size(); ++id) least[id] = std::min(least[id], straight + field[id]);
    }
    return least;
}

double SurfacePoints::along_edges(const geoidx_surface_point& a, const geoidx_surface_point& b) const {
    if (is_same(a, b)) return 0;
    const auto field = along_edges(a);
    double least = FAR;
    for (const auto& [vertex, straight] : corners_from(b)) least = std::min(least, straight + field[vertex]);
    return least;
}

double SurfacePoints::distance_from_triangle(uint32_t triangle, const Eigen::Vector3d& at) const {
    return test::distance_from_triangle({corner(triangle, 0), corner(triangle, 1), corner(triangle, 2)}, at);
}

bool SurfacePoints::has_point(uint32_t triangle, const geoidx_surface_point& point) const {
    for (size_t k = 0; k < 3; ++k) {
        if (point.weights[k] == 0) continue;
        const uint32_t vertex = input_.mesh().triangles[3 * size_t{point.triangle} + k];
        bool is_here = false;
        for (size_t l = 0; l < 3; ++l)
            is_here = is_here ||
                      input_.surface().are_one(vertex, input_.mesh().triangles[3 * size_t{triangle} + l]);
        if (!is_here) return false;
    }
    return true;
}

}
