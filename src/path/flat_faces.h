#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "src/mesh/mesh.h"

namespace geodesic {

// The faces that flip_flat_edges() makes of planes, beside those of the mesh that it takes for them. An index
// is made on these: the distances of their corners, which lie around a point, tell more of it than those of
// the corners of a sliver. A mesh without such planes has none, and takes no memory.
class FlatFaces {
public:
    explicit FlatFaces(const Mesh& mesh);

    // A point of one of these faces.
    struct Point {
        std::array<uint32_t, 3> corners;
        std::array<double, 3> weights;
        std::array<bool, 3> has_face_beyond; // over the edge opposite to each corner
    };

    // A point of the mesh, or nothing where its face is no other than in the mesh, or where rounding hides
    // which one it is. `corners` and `weights` are those of the mesh's face.
    std::optional<Point> find(std::span<const Eigen::Vector3d> positions, uint32_t face,
                              const std::array<uint32_t, 3>& corners,
                              const std::array<double, 3>& weights) const;

private:
    // What is across an edge: the place of one of these faces, or
    static constexpr uint32_t NOTHING = NONE, OTHER = NONE - 1; // a face of the mesh, or several

    class Walk;

    std::optional<uint32_t> place_of(uint32_t face) const;
    std::span<const std::pair<uint32_t, uint32_t>> around(uint32_t vertex) const;

    std::vector<uint32_t> replaced_; // faces of the mesh, in ascending order
    std::vector<std::array<uint32_t, 3>> faces_, across_;
    std::vector<std::pair<uint32_t, uint32_t>> at_vertices_; // vertex and place of a face there, in order
};

}
