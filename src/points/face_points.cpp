#include "src/points/face_points.h"

#include <algorithm>
#include <string>

#include "format/error.h"
#include "geoidx.h"
#include "src/overlay/fields/point_ways.h"
#include "src/points/leaf_of_face.h"
#include "src/points/seen_faces.h"
#include "src/surface/indexed_faces.h"

namespace geodesic {

namespace {

struct PointOfFace {
    AnyFace face;
    std::array<double, 3> weights;
};

// As a point of the faces that the index was made on. At a vertex, one face is as good as another.
PointOfFace unfolded_point(const Surface& surface, const SurfacePoint& point) {
    if (vertex_at(surface, point) == NONE)
        if (const auto indexed = indexed_point(surface, point))
            return {{true, indexed->face}, indexed->weights};
    return {{false, point.face}, point.weights};
}

class FacesOfLeaf final : public KnownFaces {
public:
    FacesOfLeaf(const Index& index, const Surface& surface, uint32_t leaf)
        : index_(index), overlay_(std::get<OverlayIndex>(index.engine)), surface_(surface), leaf_(leaf) {}

    uint32_t number_of(uint32_t vertex) const override {
        const uint32_t number = geodesic::number_of(index_, surface_, vertex);
        return number != NONE && is_in_leaf(overlay_.numbering, leaf_, number) ? number : NONE;
    }
    bool go_on(uint32_t a, uint32_t b, double length) const override {
        return !is_on_border(overlay_, leaf_, a, b, length);
    }
    size_t find_between(uint32_t a, uint32_t b, double length,
                        std::span<VertexBetween> found) const override {
        const size_t count = find_on_border(overlay_, leaf_, a, b, length, found).value_or(0);
        return count <= found.size() ? count : 0;
    }

private:
    const Index& index_;
    const OverlayIndex& overlay_;
    const Surface& surface_;
    const uint32_t leaf_;
};

}

void require_same_mesh(const Index& index, const Surface& surface) {
    const Description& about = index.description;
    if (about.mesh_fingerprint != surface.fingerprint || about.id_count != surface.vertex_of_id.size() ||
        about.triangle_count != surface.face_of_triangle.size())
        throw Error(GEOIDX_ERROR_MESH_MISMATCH, "the surface is of another mesh than the index");
    if (surface.vertex_count() != index.vertices_with_id)
        refuse_argument("the surface has " + std::to_string(surface.vertex_count()) +
                        " different vertices, the index " + std::to_string(index.vertices_with_id) +
                        ": they differ in weld_tolerance");
}

void require_edge_costs(const Index& index, const Surface& surface) {
    if (surface.costs.edge_fingerprint == 0)
        refuse_argument("the index was built with edge costs: the surface needs edge_costs");
    if (surface.costs.edge_fingerprint != index.description.metric_fingerprint)
        refuse_argument("edge_costs of the surface are not those that the index was built with");
}

// An index does not tell lengths of edges from other costs.
void require_face_costs(const Index& index, const Surface& surface) {
    if (surface.costs.of_face.empty())
        refuse_argument("the metric of the index is GEOIDX_METRIC_WEIGHTED: the surface needs face_costs");
    if (surface.costs.face_fingerprint != index.description.metric_fingerprint)
        refuse_argument("face_costs or points_per_edge of the surface are not those that the index was built "
                        "with, or it was built with edge_lengths, for which there are no paths");
}

FacePoint face_point_on(const Index& index, const Surface& surface, const SurfacePoint& point, bool unfolds,
                        double cost) {
    const PointOfFace at =
        unfolds ? unfolded_point(surface, point) : PointOfFace{{false, point.face}, point.weights};
    const auto corners = corners_of(surface, at.face);
    std::array<bool, 3> crosses;
    std::array<uint32_t, 3> numbers;
    std::array<double, 3> lengths = edge_lengths(surface, corners);
    for (size_t k = 0; k < 3; ++k) {
        numbers[k] = number_of(index, surface, corners[k]);
        crosses[k] = unfolds && has_face_beyond(surface, at.face, corners[(k + 1) % 3], corners[(k + 2) % 3]);
        lengths[k] *= cost;
    }
    if (std::ranges::find(numbers, NONE) != numbers.end())
        refuse_argument("the surface has a triangle that the index does not: they differ in weld_tolerance");
    FacePoint found = face_point(numbers, lengths, at.weights, crosses);
    if (std::holds_alternative<OverlayIndex>(index.engine))
        found.leaf = leaf_of_face(index, surface, at.face);
    return found;
}

PointView view_from(const Index& index, const Surface& surface, const SurfacePoint& at,
                    const FacePoint& point) {
    PointView view(point);
    if (point.leaf == NONE || point.vertex != NONE) return view;
    if (const auto indexed = indexed_point(surface, at))
        see_farther(surface, *indexed, FacesOfLeaf(index, surface, point.leaf),
                    most_vertices_of_polygon(surface, indexed_corners(surface, indexed->face)), view.point,
                    view.seen);
    return view;
}

void share_leaf(const Index& index, FacePoint& a, FacePoint& b) {
    const bool are_apart = a.leaf != NONE && b.leaf != NONE && a.leaf != b.leaf;
    if (!are_apart || a.vertex != NONE || b.vertex != NONE) return;
    const Numbering& numbering = index.numbering();
    const bool b_fits = are_in_leaf(numbering, a.leaf, b.corners()),
               a_fits = are_in_leaf(numbering, b.leaf, a.corners());
    if (b_fits && a_fits)
        a.leaf = b.leaf = std::min(a.leaf, b.leaf);
    else if (b_fits)
        b.leaf = a.leaf;
    else if (a_fits)
        a.leaf = b.leaf;
}

}
