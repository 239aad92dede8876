#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "src/index/face_point.h"
#include "src/surface/surface.h"

namespace geodesic {

// The faces behind that of a point, unfolded into its plane, as far as straight lines from the point reach
// them. The point is the origin. All faces here are those of the index (see indexed_faces.h).
struct SeenFaces {
    struct Face {
        uint32_t face;
        std::array<Eigen::Vector2d, 3> corners;
        Eigen::Vector2d right, left; // the directions between which lines come in
    };

    size_t count = 0;
    std::array<Face, FacePoint::MOST_VERTICES> faces;

    // The length of the straight line to another point of the surface, in the faces that it lies in; infinite
    // if there is none.
    double straight_to(const Surface& surface, const SurfacePoint& point) const;
};

// What an index knows of the faces of a surface. Edges are given by the numbers of their ends.
class KnownFaces {
public:
    // The number of a vertex, or NONE where distances from it are not known.
    virtual uint32_t number_of(uint32_t vertex) const = 0;
    // Whether the face behind an edge is known, too.
    virtual bool go_on(uint32_t a, uint32_t b, double length) const = 0;
    // Writes the vertices that the index has between the ends of an edge, from the first end on, and returns
    // how many it wrote: all of them, or none where there is no room for all.
    virtual size_t find_between(uint32_t a, uint32_t b, double length,
                                std::span<VertexBetween> found) const = 0;

protected:
    ~KnownFaces() = default;
};

// Unfolds faces around a point, those behind the widest edges first, until its polygon has `most` vertices,
// which are no more than MOST_VERTICES. Then cuts the polygon's edges at the vertices that are known between
// their ends, as far as there is room for them. `point` comes as the polygon of its face alone, which `at` is
// a point of.
void see_farther(const Surface& surface, const SurfacePoint& at, const KnownFaces& known, size_t most,
                 FacePoint& point, SeenFaces& seen);

// The faces around a point with the vertices of their polygon, which has none if no face is seen. straight[k]
// is from vertices[k] to the point, infinite if the point does not see it.
struct SeenAround {
    SeenFaces faces;
    uint32_t vertex_count = 0;
    std::array<uint32_t, FacePoint::MOST_VERTICES> vertices; // of the surface
    std::array<double, FacePoint::MOST_VERTICES> straight;
};

// What a point that is at no vertex sees, as far as a polygon of `most` vertices goes, whatever an index
// knows of it. `at` is a point of the faces of an index.
SeenAround see_around(const Surface& surface, const SurfacePoint& at, size_t most);

// Up to how many vertices the polygon of a point on a face with these corners grows: more where edges are
// long for the component that the face lies in, since the error of a polygon that ends early is a share of an
// edge. Vertices that were added between the ends of its edges come besides, for which 32 places are left at
// least.
size_t most_vertices_of_polygon(const Surface& surface, const std::array<uint32_t, 3>& corners);

}
