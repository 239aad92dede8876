#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "geoidx.h"
#include "src/mesh/mesh.h"

namespace geodesic::test {

// Triangles as a caller has them, before any clean-up.
struct Soup {
    std::vector<Eigen::Vector3d> positions;
    std::vector<std::array<uint32_t, 3>> triangles;

    uint32_t vertex_count() const { return static_cast<uint32_t>(positions.size()); }
};

// A random number in [low, high), the same on every platform.
double uniform(std::mt19937_64& random, double low, double high);

// Points into the soup, which must outlive it.
geoidx_mesh view_of(const Soup& soup);

// The soup as it is: every vertex must be used and nothing in it to be dropped. Ids stay.
Mesh mesh_of(const Soup& soup);

// ---- Flat meshes, z = 0

// columns x rows cells of two triangles; vertex x + y * (columns + 1) is at (x * width / columns, ...).
Soup grid(uint32_t columns, uint32_t rows, double width, double height);
// The unit square: inner vertices moved by up to 0.3 of a cell, diagonals at random.
Soup jittered_grid(uint32_t cells, uint64_t seed);
// The unit square: a Delaunay triangulation of its corners and of random points.
Soup delaunay_square(uint32_t inner_points, uint64_t seed);
// [0, 2] x [0, 2] without the open quadrant x > 1, y > 1: a reflex corner at (1, 1).
Soup l_shape(uint32_t cells_per_unit);
// A ring of faces between radius 1 and 2: an annulus.
Soup annulus(uint32_t sectors, uint32_t rings);
// Two grids that share one vertex: 0, at the origin, in the middle of the first (z = 0) and at a corner of
// the second (x = 0, the others z > 0).
Soup pinched_sheets(uint32_t half_cells);
// The unit square, and two fins of height 1/2 that stand on it at x = 1/3 and x = 2/3, up to y = 1: edges of
// three triangles. `cells` per 1/6.
Soup comb(uint32_t cells);

// ---- Other surfaces

// The unit cube [0, 1]^3, each face cells x cells.
Soup cube(uint32_t cells);
// Flat facets between consecutive unit rays, closed around; the apex is vertex 0, vertex
// 1 + ray + rays * (ring - 1) is at ray * ring / rings.
Soup cone(std::span<const Eigen::Vector3d> rays, uint32_t rings);
// Rays of a cone of revolution whose rays rise by `slope`, in radians.
std::vector<Eigen::Vector3d> cone_rays(uint32_t count, double slope);
// Rays that rise and fall by turns (count is even): more than 2 pi around the apex.
std::vector<Eigen::Vector3d> saddle_rays(uint32_t count, double slope);
// A disk of ten sectors and three rings around a vertex, in one plane; with two turns it lies over itself.
Soup flat_fan(uint32_t turns);
// The same without its middle, and cut through from there: a strip that goes around and around.
Soup flat_spiral(uint32_t turns);
// A cylinder of radius 1 as tools write it: sides of two triangles each, and caps that are fans around a
// vertex of the rim.
Soup closed_cylinder(uint32_t sides, double height);

// An open prism: `sides` flat sides of width 1 and height `height`; vertex side + sides * level.
Soup prism(uint32_t sides, uint32_t levels, double height);
Soup torus(uint32_t around, uint32_t across, double radius, double thickness);
// An octahedron, each triangle split in four `subdivisions` times, on the unit sphere.
Soup sphere(uint32_t subdivisions);
// A sphere with random radii, some of its faces split into needles and caps.
Soup bumpy_sphere(uint32_t subdivisions, uint64_t seed);
// A band with a half twist: it has one side only.
Soup moebius(uint32_t around, uint32_t across);

// ---- Changes

// Both, as separate components; the second's ids begin at a.vertex_count().
Soup joined(const Soup& a, const Soup& b);
// Vertices renumbered (new_id[old id]), triangles in another order, their corners rotated.
Soup shuffled(const Soup& soup, uint64_t seed, std::vector<uint32_t>& new_id);
// About half of the triangles turned over.
Soup with_mixed_winding(const Soup& soup, uint64_t seed);
Soup with_flipped_winding(const Soup& soup);
// The same surface, cut badly: in each round about half of the edges between two faces of one plane are
// flipped, wherever these are a convex quadrangle. After some rounds there are slivers as long as the plane.
Soup with_random_diagonals(const Soup& soup, uint32_t rounds, uint64_t seed);

}
