#include "src/mesh/halve_edges.h"

#include <algorithm>
#include <utility>

namespace geodesic {

namespace {

using Face = std::array<uint32_t, 3>;

// A face whose corners are rotated, so that `middles[k]` is the middle of the edge opposite to `corners[k]`,
// or NONE where that edge is not cut.
struct CutFace {
    Face corners, middles;

    uint32_t cut_count() const { return 3 - static_cast<uint32_t>(std::ranges::count(middles, NONE)); }

    void rotate() {
        std::rotate(corners.begin(), corners.begin() + 1, corners.end());
        std::rotate(middles.begin(), middles.begin() + 1, middles.end());
    }
};

// Divides faces into parts, which have the orientation of the whole.
class FaceDivider {
public:
    FaceDivider(const std::vector<Eigen::Vector3d>& positions, std::vector<Face>& parts)
        : positions_(positions), parts_(parts) {}

    void divide(CutFace face) {
        switch (face.cut_count()) {
        case 0:
            parts_.push_back(face.corners);
            break;
        case 1:
            divide_into_two(face);
            break;
        case 2:
            divide_into_three(face);
            break;
        default:
            divide_into_four(face);
        }
    }

private:
    void divide_into_two(CutFace face) {
        while (face.middles[0] == NONE) face.rotate();
        const auto [a, b, c] = face.corners;
        parts_.push_back({a, b, face.middles[0]});
        parts_.push_back({a, face.middles[0], c});
    }

    // A corner, and two halves of what is left beside the whole edge. The shorter diagonal makes their
    // angles the larger ones.
    void divide_into_three(CutFace face) {
        while (face.middles[0] != NONE) face.rotate();
        const auto [a, b, c] = face.corners;
        const uint32_t of_ca = face.middles[1], of_ab = face.middles[2];
        parts_.push_back({a, of_ab, of_ca});
        if (squared_length(b, of_ca) < squared_length(c, of_ab)) {
            parts_.push_back({of_ab, b, of_ca});
            parts_.push_back({b, c, of_ca});
        } else {
            parts_.push_back({of_ab, b, c});
            parts_.push_back({of_ab, c, of_ca});
        }
    }

    void divide_into_four(const CutFace& face) {
        for (size_t k = 0; k < 3; ++k)
            parts_.push_back({face.corners[k], face.middles[(k + 2) % 3], face.middles[(k + 1) % 3]});
        parts_.push_back(face.middles);
    }

    double squared_length(uint32_t a, uint32_t b) const {
        const Eigen::Vector3d way = positions_[b] - positions_[a];
        return way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
    }

    const std::vector<Eigen::Vector3d>& positions_;
    std::vector<Face>& parts_;
};

}

HalvedEdges halve_edges(const Mesh& mesh, std::span<const uint32_t> edges) {
    HalvedEdges halved;
    halved.mesh.positions = mesh.positions;
    std::vector<uint32_t> middle(mesh.edge_count(), NONE);
    for (const uint32_t e : edges) {
        middle[e] = halved.mesh.vertex_count();
        halved.mesh.positions.push_back(
            0.5 * (mesh.positions[mesh.edges[e][0]] + mesh.positions[mesh.edges[e][1]]));
    }
    FaceDivider divider(halved.mesh.positions, halved.mesh.faces);
    for (uint32_t f = 0; f < mesh.face_count(); ++f) {
        const auto& [a, b, c] = mesh.face_edges[f];
        divider.divide({mesh.faces[f], {middle[a], middle[b], middle[c]}});
        halved.whole_face.resize(halved.mesh.faces.size(), f);
    }
    connect(halved.mesh);
    return halved;
}

}
