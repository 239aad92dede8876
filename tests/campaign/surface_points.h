#pragma once

#include <array>
#include <string>
#include <vector>

#include "tests/campaign/build_input.h"
#include "tests/campaign/dice.h"

namespace geodesic::campaign {

std::string described(const geoidx_surface_point& point);
bool is_same(const geoidx_surface_point& a, const geoidx_surface_point& b); // in every number

// The surface of a case and points of it, of which everything is found anew in the plainest way.
class SurfacePoints {
public:
    explicit SurfacePoints(const BuildInput& input);

    const geoidx_surface* surface() const { return surface_.get(); }

    // A point at a vertex, on an edge or within a triangle; at a vertex if nothing else is asked for.
    geoidx_surface_point random_point(Dice& dice, bool is_at_vertex) const;

    // The vertex that a point is at, or GEOIDX_NO_SOURCE.
    uint32_t vertex_of(const geoidx_surface_point& point) const;
    // Of the corners of its triangle.
    std::array<uint32_t, 3> vertices(const geoidx_surface_point& point) const;
    Eigen::Vector3d position(const geoidx_surface_point& point) const;
    bool are_joined(const geoidx_surface_point& a, const geoidx_surface_point& b) const;

    // Of a point: how far every vertex is straight to a corner and along edges from there, as
    // BuildInput::edge_bounds() has them.
    std::vector<double> along_edges(const geoidx_surface_point& point) const;
    // The same between two points; 0 for a point and itself.
    double along_edges(const geoidx_surface_point& a, const geoidx_surface_point& b) const;

    // How far a position is from a triangle, be it a needle.
    double distance_from_triangle(uint32_t triangle, const Eigen::Vector3d& at) const;
    // Whether a triangle has all corners that a point has weights of.
    bool has_point(uint32_t triangle, const geoidx_surface_point& point) const;
    // What a straight piece between two points of a triangle costs for each unit of its length: that of the
    // cheapest triangle that has both, along an edge and where triangles are duplicates.
    double cost_of_piece(const geoidx_surface_point& a, const geoidx_surface_point& b) const;
    // The largest coordinate, by which positions are rounded.
    double extent() const { return extent_; }

private:
    // A corner, and how far a point is straight from it.
    struct Corner {
        uint32_t vertex;
        double straight;
    };

    std::vector<Corner> corners_from(const geoidx_surface_point& point) const; // one for a point at a vertex
    Eigen::Vector3d corner(uint32_t triangle, size_t k) const;

    const BuildInput& input_;
    SurfaceHandle surface_;
    double extent_ = 0;
};

}
