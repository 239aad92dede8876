#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "src/mesh/mesh.h"
#include "src/metric/metric.h"

namespace geodesic {

// The faces of planes in which flip_flat_edges() flips edges, beside those that the mesh itself has there. An
// index is made on these: the distances of their corners, which lie around a point, tell more of it than
// those of the corners of a sliver. Where nothing is flipped there are none, and they take no memory; else
// some 60 bytes for each face.
class FlatFaces {
public:
    FlatFaces() = default;
    explicit FlatFaces(const Mesh& mesh);

    // A point of one of these faces.
    struct Point {
        std::array<uint32_t, 3> corners;
        std::array<double, 3> weights;
        std::array<bool, 3> has_face_beyond; // over the edge opposite to each corner
    };

    // A point of the mesh as one of these faces. Nothing where nothing is flipped in its plane, or where
    // rounding hides which face it lies in. `mesh` has positions and faces of the mesh.
    template <class AnyMesh>
    std::optional<Point> find(const AnyMesh& mesh, const SurfacePoint& point) const {
        const auto slot = slot_of(point.face);
        if (!slot) return std::nullopt;
        const auto found = locate(mesh.positions, corners_of(mesh, point), plane_[*slot]);
        if (!found) return std::nullopt;
        return point_at(*found);
    }

    // Whether edges are flipped in the plane of a face of the mesh.
    bool has(uint32_t face) const { return slot_of(face).has_value(); }

    // The length of the straight line between two points of the mesh if it runs over faces of one plane;
    // infinite otherwise. It is the same in both directions.
    template <class AnyMesh>
    double straight(const AnyMesh& mesh, const SurfacePoint& a, const SurfacePoint& b) const {
        const auto slot_of_a = slot_of(a.face), slot_of_b = slot_of(b.face);
        if (!slot_of_a || !slot_of_b || plane_[*slot_of_a] != plane_[*slot_of_b]) return UNREACHABLE;
        return straight_between(mesh.positions, corners_of(mesh, a), corners_of(mesh, b), plane_[*slot_of_a]);
    }

private:
    // A point by a face of the mesh, the corner with the largest weight first.
    struct Corners {
        std::array<uint32_t, 3> vertices;
        Eigen::Vector3d position;
        bool is_vertex; // the first one
    };
    // A slot is the place of a face in all lists but the last one.
    struct Located {
        uint32_t slot;
        std::array<double, 3> weights;
    };
    class Walk;

    // What is across an edge: the slot of one of these faces in the same plane, or
    static constexpr uint32_t NOTHING = NONE, OTHER = NONE - 1; // any others

    template <class AnyMesh>
    static Corners corners_of(const AnyMesh& mesh, const SurfacePoint& point) {
        return corners_of(mesh.positions, mesh.faces[point.face], point.weights);
    }
    static Corners corners_of(std::span<const Eigen::Vector3d> positions,
                              const std::array<uint32_t, 3>& corners, const std::array<double, 3>& weights);
    std::optional<uint32_t> slot_of(uint32_t face) const;
    std::span<const std::pair<uint32_t, uint32_t>> around(uint32_t vertex) const;
    std::optional<Located> locate(std::span<const Eigen::Vector3d> positions, const Corners& point,
                                  uint32_t plane) const;
    double straight_between(std::span<const Eigen::Vector3d> positions, const Corners& a, const Corners& b,
                            uint32_t plane) const;
    Point point_at(const Located& located) const;

    std::vector<uint32_t> replaced_; // the numbers that the faces have in both meshes, in ascending order
    std::vector<uint32_t> plane_;    // as in FlippedEdges
    std::vector<std::array<uint32_t, 3>> faces_, across_;
    std::vector<std::pair<uint32_t, uint32_t>> at_vertices_; // vertex and slot of a face there, in order
};

}
