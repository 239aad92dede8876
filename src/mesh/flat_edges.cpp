#include "src/mesh/flat_edges.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include <Eigen/Geometry>

#include "src/base/plane.h"

namespace geodesic {

namespace {

using Point = Eigen::Vector3d;

// Two faces beside an edge from `a` to `b`: c, a, b and d, b, a. Corner numbers are places in their faces.
struct Quadrangle {
    uint32_t first, second; // the faces
    uint32_t first_corner, second_corner;
    uint32_t a, b, c, d;
};

// How much longer the other diagonal may be along the surface than straight through space, as a share.
constexpr double FLATNESS = 1e-8;

// By how much the two opposite angles must be more than half a turn together, in radians: of the corners of a
// square, rounding decides.
constexpr double ANGLE = 1e-3;

// Whether the circle around the first face has the opposite corner of the second one inside, if both are laid
// into one plane.
bool is_delaunay(const Point& a, const Point& b, const Point& c, const Point& d) {
    const Point ca = a - c, cb = b - c, da = a - d, db = b - d;
    const double sine = ca.cross(cb).norm() * da.dot(db) + da.cross(db).norm() * ca.dot(cb);
    return sine >= -ANGLE * ca.norm() * cb.norm() * da.norm() * db.norm();
}

// Whether c to d is as long straight through space as in the plane into which both faces are laid.
bool is_flat(const Point& a, const Point& b, const Point& c, const Point& d) {
    const double length = (b - a).norm();
    const Point along = (b - a) / length;
    const double foot_of_c = along.dot(c - a), foot_of_d = along.dot(d - a);
    const double height_of_c = along.cross(c - a).norm(), height_of_d = along.cross(d - a).norm();
    const double unfolded = hypotenuse(foot_of_d - foot_of_c, height_of_c + height_of_d);
    return unfolded > 0 && (c - d).norm() >= (1 - FLATNESS) * unfolded;
}

class Flipping {
public:
    explicit Flipping(const Mesh& mesh)
        : mesh_(mesh), faces_(mesh.faces), face_edges_(mesh.face_edges),
          is_waiting_(mesh.edge_count(), false) {
        for (uint32_t e = 0; e < mesh.edge_count(); ++e) {
            const auto beside = mesh.edge_faces[e];
            sides_.push_back(beside.size() == 2 ? std::array{beside[0], beside[1]} : std::array{NONE, NONE});
        }
    }

    // Returns whether any edge was flipped.
    bool run() {
        for (uint32_t e = mesh_.edge_count(); e-- > 0;) put(e);
        uint64_t left = MOST_FLIPS_AN_EDGE * mesh_.edge_count();
        bool any = false;
        while (!waiting_.empty() && left > 0) {
            const uint32_t edge = waiting_.back();
            waiting_.pop_back();
            is_waiting_[edge] = false;
            if (!may_flip(edge)) continue;
            flip(edge);
            any = true;
            --left;
        }
        return any;
    }

    std::vector<std::array<uint32_t, 3>> take_faces() { return std::move(faces_); }

private:
    // Each flip makes angles larger, so that flipping ends; this bounds what rounding might do.
    static constexpr uint64_t MOST_FLIPS_AN_EDGE = 1000;

    void put(uint32_t edge) {
        if (sides_[edge][0] == NONE || is_waiting_[edge]) return;
        is_waiting_[edge] = true;
        waiting_.push_back(edge);
    }

    uint32_t corner_opposite(uint32_t face, uint32_t edge) const {
        return static_cast<uint32_t>(std::ranges::find(face_edges_[face], edge) - face_edges_[face].begin());
    }

    Quadrangle quadrangle(uint32_t edge) const {
        const auto [first, second] = sides_[edge];
        const uint32_t i = corner_opposite(first, edge), j = corner_opposite(second, edge);
        const auto& corners = faces_[first];
        return {first,      second,           i, j, corners[(i + 1) % 3], corners[(i + 2) % 3],
                corners[i], faces_[second][j]};
    }

    bool may_flip(uint32_t edge) const {
        const Quadrangle q = quadrangle(edge);
        const auto& at = mesh_.positions;
        return !is_delaunay(at[q.a], at[q.b], at[q.c], at[q.d]) &&
               is_flat(at[q.a], at[q.b], at[q.c], at[q.d]) && q.c != q.d &&
               find_edge(mesh_, q.c, q.d) == NONE && !new_edges_.contains(key(q.c, q.d));
    }

    static uint64_t key(uint32_t a, uint32_t b) { return uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

    // The faces c, a, b and d, b, a become c, a, d and c, d, b.
    void flip(uint32_t edge) {
        const Quadrangle q = quadrangle(edge);
        const auto opposite = [&](uint32_t face, uint32_t corner) {
            return face_edges_[face][static_cast<size_t>(std::ranges::find(faces_[face], corner) -
                                                         faces_[face].begin())];
        };
        const uint32_t bc = opposite(q.first, q.a), ca = opposite(q.first, q.b);
        const uint32_t ad = opposite(q.second, q.b), bd = opposite(q.second, q.a);
        faces_[q.first] = {q.c, q.a, q.d};
        face_edges_[q.first] = {ad, edge, ca};
        faces_[q.second] = {q.c, q.d, q.b};
        face_edges_[q.second] = {bd, bc, edge};
        replace_side(ad, q.second, q.first);
        replace_side(bc, q.first, q.second);
        new_edges_.erase(key(q.a, q.b));
        new_edges_.insert(key(q.c, q.d));
        for (const uint32_t beside : {bc, ca, ad, bd}) put(beside);
    }

    void replace_side(uint32_t edge, uint32_t before, uint32_t after) {
        for (uint32_t& face : sides_[edge])
            if (face == before) face = after;
    }

    const Mesh& mesh_;
    std::vector<std::array<uint32_t, 3>> faces_, face_edges_;
    std::vector<std::array<uint32_t, 2>> sides_; // per edge: its faces, or NONE if it does not have two
    std::unordered_set<uint64_t> new_edges_;     // that the mesh did not have
    std::vector<uint32_t> waiting_;
    std::vector<bool> is_waiting_;
};

}

std::optional<Mesh> flip_flat_edges(const Mesh& mesh) {
    Flipping flipping(mesh);
    if (!flipping.run()) return std::nullopt;
    Mesh flipped;
    flipped.positions = mesh.positions;
    flipped.faces = flipping.take_faces();
    connect(flipped);
    return flipped;
}

}
