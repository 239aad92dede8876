#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "src/base/ranked_set.h"
#include "src/mesh/flat_edges.h"
#include "src/metric/metric.h"

namespace geodesic {

// The faces of planes in which flip_flat_edges() flips edges, beside those that the mesh itself has there. An
// index is made on these: the distances of their corners, which lie around a point, tell more of it than
// those of the corners of a sliver. Where nothing is flipped there are none, and they take no memory; else
// some 60 bytes for each face.
class FlatFaces {
public:
    FlatFaces() = default;
    // What flip_flat_edges() returns for a mesh.
    explicit FlatFaces(const std::optional<FlippedEdges>& flipped);

    // Whether edges are flipped in the plane of a face of the mesh. A face of that number is one of these,
    // too, but not at the same place of the plane.
    bool has(uint32_t face) const { return replaced_.contains(face); }
    // Of a face that it has.
    const std::array<uint32_t, 3>& corners(uint32_t face) const { return faces_[replaced_.rank(face)]; }
    // Calls use(face) for each of these faces around a vertex.
    template <class Use>
    void for_each_around(uint32_t vertex, const Use& use) const {
        for (const uint32_t row : around(vertex)) use(number_[row]);
    }

    // A point of the mesh as one of these faces. Nothing where nothing is flipped in its plane, or where
    // rounding hides which face it lies in. `mesh` has positions and faces of the mesh.
    template <class AnyMesh>
    std::optional<SurfacePoint> find(const AnyMesh& mesh, const SurfacePoint& point) const {
        if (!has(point.face)) return std::nullopt;
        const auto found = locate(mesh.positions, corners_of(mesh, point), plane_of(point.face));
        if (!found) return std::nullopt;
        return point_at(*found);
    }

    // The length of the straight line between two points of the mesh if it runs over faces of one plane;
    // infinite otherwise. It is the same in both directions.
    template <class AnyMesh>
    double straight(const AnyMesh& mesh, const SurfacePoint& a, const SurfacePoint& b) const {
        if (!has(a.face) || !has(b.face) || plane_of(a.face) != plane_of(b.face)) return UNREACHABLE;
        return straight_between(mesh.positions, corners_of(mesh, a), corners_of(mesh, b), plane_of(a.face));
    }

private:
    // A point by a face of the mesh, the corner with the largest weight first.
    struct Corners {
        std::array<uint32_t, 3> vertices;
        Eigen::Vector3d position;
        bool is_vertex; // the first one
    };
    // By the row of a face in the lists below.
    struct Located {
        uint32_t row;
        std::array<double, 3> weights;
    };
    class Walk;

    template <class AnyMesh>
    static Corners corners_of(const AnyMesh& mesh, const SurfacePoint& point) {
        return corners_of(mesh.positions, mesh.faces[point.face], point.weights);
    }
    static Corners corners_of(std::span<const Eigen::Vector3d> positions,
                              const std::array<uint32_t, 3>& corners, const std::array<double, 3>& weights);
    uint32_t plane_of(uint32_t face) const { return plane_[replaced_.rank(face)]; }
    std::span<const uint32_t> around(uint32_t vertex) const; // rows of faces
    std::optional<Located> locate(std::span<const Eigen::Vector3d> positions, const Corners& point,
                                  uint32_t plane) const;
    double straight_between(std::span<const Eigen::Vector3d> positions, const Corners& a, const Corners& b,
                            uint32_t plane) const;
    void list_around_vertices(std::vector<std::pair<uint32_t, uint32_t>> at_vertices, uint32_t vertex_count);
    SurfacePoint point_at(const Located& located) const;

    // A face has the row that is the rank of its number.
    RankedSet replaced_;           // the numbers that the faces have in both meshes
    std::vector<uint32_t> number_; // the same in ascending order
    std::vector<uint32_t> plane_;  // as in FlippedEdges
    std::vector<std::array<uint32_t, 3>> faces_;
    std::vector<std::array<uint32_t, 3>> across_; // the row of the one other face at an edge, if that lies
                                                  // in the same plane, or NONE
    RankedSet vertices_;                          // that have such a face
    std::vector<uint32_t> around_begin_, around_; // by rank, the rows of faces around each of these
};

}
