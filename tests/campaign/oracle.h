#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "tests/support/meshes.h"

namespace geodesic::campaign {

constexpr double FAR = std::numeric_limits<double>::infinity();

// What the library makes of a mesh, found out anew in the plainest way: which vertices are one, what hangs
// together, and how far it is along edges. Vertices are the caller's ids.
class Surface {
public:
    using Edge = std::array<uint32_t, 2>;

    Surface(const test::Soup& soup, double weld_tolerance);

    uint32_t vertex_count() const { return static_cast<uint32_t>(representative_.size()); }
    bool has_triangles() const { return !triangles_.empty(); }
    uint32_t welded_vertex_count() const; // of vertices that a triangle uses
    bool is_used(uint32_t id) const { return used_[representative_[id]] != 0; }
    uint32_t representative(uint32_t id) const { return representative_[id]; }
    bool are_one(uint32_t a, uint32_t b) const {
        return a == b || (is_used(a) && representative_[a] == representative_[b]);
    }
    bool are_joined(uint32_t a, uint32_t b) const {
        return a == b || (is_used(a) && is_used(b) && part_[representative_[a]] == part_[representative_[b]]);
    }

    // Triangles of the caller that have three different vertices, with representatives for ids.
    struct Triangle {
        uint32_t number;
        std::array<uint32_t, 3> vertices;
    };
    const std::vector<Triangle>& triangles() const { return triangles_; }
    // Each once, the smaller representative first.
    const std::vector<Edge>& edges() const { return edges_; }
    // Whether two triangles at an edge lie in one plane, or nearly: the library may then cut their quadrangle
    // along its other diagonal.
    bool has_flat_edges(const test::Soup& soup) const;

    // Of every id, from a source, over edges with such costs, in the order of edges().
    std::vector<double> along_edges(std::span<const double> costs, uint32_t source) const;

private:
    void find_edges();
    void find_parts();

    std::vector<uint32_t> representative_;
    std::vector<uint8_t> used_; // by representative, as is part_
    std::vector<uint32_t> part_;
    std::vector<Triangle> triangles_;
    std::vector<Edge> edges_;
    std::vector<std::vector<std::array<uint32_t, 2>>> edges_at_; // edge, other end
};

}
