#pragma once

#include "src/index/face_point.h"
#include "src/points/seen_faces.h"
#include "src/query/query.h"
#include "src/surface/surface.h"

namespace geodesic {

// Throws Error MESH_MISMATCH where the surface is of another mesh than the index, INVALID_ARGUMENT where it
// has another number of vertices after welding.
void require_same_mesh(const Index& index, const Surface& surface);

// Throw Error INVALID_ARGUMENT unless the surface has the costs that an index by edge costs, or by those of
// faces, was built with.
void require_edge_costs(const Index& index, const Surface& surface);
void require_face_costs(const Index& index, const Surface& surface);

// The number that the index has for a vertex, or NONE.
inline uint32_t number_of(const Index& index, const Surface& surface, uint32_t vertex) {
    return index.number_of_id[surface.id_of_vertex[vertex]];
}

// The distance of a vertex from an end that the query has prepared.
inline double end_distance(const Index& index, Query& query, const Surface& surface, size_t end,
                           uint32_t vertex) {
    const uint32_t number = number_of(index, surface, vertex);
    return number == NONE ? UNREACHABLE : double{query.end_distance(end, number)};
}

// The point as queries take it. If the metric unfolds, ways may cross the edges that have a face beyond.
// Lengths in the face count `cost` times. Throws Error INVALID_ARGUMENT where the index does not have all
// corners of the face.
FacePoint face_point_on(const Index& index, const Surface& surface, const SurfacePoint& point, bool unfolds,
                        double cost = 1);

// The same by a metric that unfolds, with the faces around the point as far as the index tells of them.
struct PointView {
    explicit PointView(const FacePoint& point) : point(point) {}

    FacePoint point;
    SeenFaces seen;
};
PointView view_from(const Index& index, const Surface& surface, const SurfacePoint& at,
                    const FacePoint& point);

// Where a leaf of two points that are at no vertex has both, it becomes the leaf of both, whichever comes
// first.
void share_leaf(const Index& index, FacePoint& a, FacePoint& b);

}
