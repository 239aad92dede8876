#include "src/path/vertex_path.h"

#include <algorithm>
#include <string>

#include "format/error.h"
#include "geoidx.h"
#include "src/path/edge_search.h"
#include "src/path/strip.h"
#include "src/points/face_points.h"
#include "src/surface/costs.h"
#include "src/surface/nearby.h"

namespace geodesic {

namespace {

bool is_length_of_edges(const Description& about) {
    return about.metric == GEOIDX_METRIC_EDGES && about.metric_fingerprint == 0;
}

class VertexPathFinder {
public:
    VertexPathFinder(const Index& index, Query& query, const Surface& surface)
        : index_(index), query_(query), surface_(surface) {}

    SurfacePath find(const SurfacePoint& source, const SurfacePoint& target);

private:
    double edge_length(uint32_t a, uint32_t b) const;
    double rest_from(uint32_t vertex) { return end_distance(index_, query_, surface_, 1, vertex); }
    std::vector<VertexEnd> ends_of(const SurfacePoint& point) const;
    std::vector<SurfacePoint> points_over(const SurfacePoint& source, const std::vector<uint32_t>& vertices,
                                          const SurfacePoint& target) const;
    double length_of_piece(const std::vector<SurfacePoint>& points, size_t i) const;

    const Index& index_;
    Query& query_;
    const Surface& surface_;
};

double VertexPathFinder::edge_length(uint32_t a, uint32_t b) const {
    if (index_.description.metric == GEOIDX_METRIC_CALLBACK)
        return double{query_.sssd(surface_.id_of_vertex[a], surface_.id_of_vertex[b])};
    return is_length_of_edges(index_.description) ? (surface_.positions[a] - surface_.positions[b]).norm()
                                                  : edge_cost(surface_, a, b);
}

std::vector<VertexEnd> VertexPathFinder::ends_of(const SurfacePoint& point) const {
    if (const uint32_t vertex = vertex_at(surface_, point); vertex != NONE) return {{vertex, 0}};
    std::vector<VertexEnd> ends;
    const Eigen::Vector3d at = position_of(surface_, point);
    for (const uint32_t corner : surface_.faces[point.face])
        ends.push_back({corner, (surface_.positions[corner] - at).norm()});
    return ends;
}

// Each vertex as a point of a face that it shares with the next one.
std::vector<SurfacePoint> VertexPathFinder::points_over(const SurfacePoint& source,
                                                        const std::vector<uint32_t>& vertices,
                                                        const SurfacePoint& target) const {
    std::vector<SurfacePoint> points{source};
    for (size_t i = 0; i < vertices.size(); ++i) {
        uint32_t face = target.face;
        if (i + 1 < vertices.size()) {
            const auto around = surface_.vertex_faces[vertices[i]];
            face = *std::ranges::find_if(
                around, [&](uint32_t f) { return has_corner(surface_, f, vertices[i + 1]); });
        }
        add_point(surface_, corner_point(surface_, face, vertices[i]), points);
    }
    add_point(surface_, target, points);
    return points;
}

double VertexPathFinder::length_of_piece(const std::vector<SurfacePoint>& points, size_t i) const {
    const uint32_t a = vertex_at(surface_, points[i]), b = vertex_at(surface_, points[i + 1]);
    if (a == NONE || b == NONE) return distance_to_next(surface_, points, i);
    return a == b ? 0 : edge_length(a, b);
}

SurfacePath VertexPathFinder::find(const SurfacePoint& source, const SurfacePoint& target) {
    if (is_same_point(surface_, source, target)) return path_within_point(source, target);
    query_.prepare_end(1, face_point_on(index_, surface_, target, false));
    const auto vertices = search_edges(
        surface_, ends_of(source), ends_of(target), [&](uint32_t v) { return rest_from(v); },
        [&](uint32_t a, uint32_t b) { return edge_length(a, b); });
    if (!vertices) no_path();
    return path_of_points(points_over(source, *vertices, target), target,
                          [&](const auto& points, size_t i) { return length_of_piece(points, i); });
}

}

void require_vertex_path_end(const Index& index, const Surface& surface, const SurfacePoint& point,
                             const char* name) {
    if (is_length_of_edges(index.description)) return;
    if (index.description.metric == GEOIDX_METRIC_EDGES) require_edge_costs(index, surface);
    if (vertex_at(surface, point) == NONE)
        refuse_argument(std::string(name) +
                        " is at no vertex, and the metric of the index is known between vertices only");
}

SurfacePath find_vertex_path(const Index& index, Query& query, const Surface& surface,
                             const SurfacePoint& source, const SurfacePoint& target) {
    return VertexPathFinder(index, query, surface).find(source, target);
}

}
