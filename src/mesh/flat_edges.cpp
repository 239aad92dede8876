#include "src/mesh/flat_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <unordered_set>
#include <utility>

#include <Eigen/Geometry>

namespace geodesic {

namespace {

using Point = Eigen::Vector3d;

// Two faces beside an edge from `a` to `b`, and their corners that are opposite to it.
struct Quadrangle {
    uint32_t first, second; // c, a, b in this order around the first one; the second may be turned over
    uint32_t a, b, c, d;
};

// By which share a way over an edge may be longer than the straight line between its ends, in one plane.
constexpr double FLATNESS = 1e-7;

// By how much the two angles opposite to an edge must be more than half a turn together, in radians. Without
// that, rounding would decide which diagonal squares get.
constexpr double ANGLE = 1e-4;

// The sum of the squares of a plane's edges that is left of that before, at most. The errors of paths across
// an edge grow with the square of its length. What is nearly as good as a Delaunay triangulation is often
// better: the rows of a grid are straighter borders.
constexpr double WORTH_IT = 0.8;

// Of corners on one circle, as those of a coin's cap, any diagonals are as good by their angles. One that is
// shorter than another by this share takes its place: a fan becomes a tree of chords, which a path crosses
// few of.
constexpr double SHORTER = 0.9;

struct Angle {
    double sine, cosine;
};

Angle angle_at(const Point& corner, const Point& a, const Point& b) {
    const Point to_a = (a - corner).normalized(), to_b = (b - corner).normalized();
    return {to_a.cross(to_b).norm(), to_a.dot(to_b)};
}

Angle sum_of(const Angle& c, const Angle& d) {
    return {c.sine * d.cosine + d.sine * c.cosine, c.cosine * d.cosine - c.sine * d.sine};
}

// Whether the angles opposite to an edge are at most half a turn together: no corner of the one face then
// lies within the circle around the other, if both are laid into one plane. If both are obtuse they are more,
// however little is missing to a whole turn.
bool is_delaunay(const Angle& c, const Angle& d) {
    const Angle sum = sum_of(c, d);
    const bool is_nearly_a_turn = c.cosine < 0 && d.cosine < 0 && sum.cosine > 0;
    return sum.sine >= -ANGLE && !is_nearly_a_turn;
}

// Whether they are half a turn together but for rounding: all four corners then lie on one circle.
bool are_on_circle(const Angle& c, const Angle& d) {
    const Angle sum = sum_of(c, d);
    return std::abs(sum.sine) <= ANGLE && sum.cosine < 0;
}

// Whether the faces of an edge from `a` to `b`, with the opposite corners `c` and `d`, lie in one plane. A
// line that crosses the edge at a right angle, from as far as the one corner is off it to as far as the other
// one is, would become shorter by the largest share.
bool are_in_one_plane(const Point& a, const Point& b, const Point& c, const Point& d) {
    const Point along = (b - a).normalized();
    const Point to_c = (c - a) - along.dot(c - a) * along, to_d = (d - a) - along.dot(d - a) * along;
    const double height_of_c = to_c.norm(), height_of_d = to_d.norm(), both = height_of_c + height_of_d;
    return both > 0 && height_of_c * height_of_d + to_c.dot(to_d) <= FLATNESS * both * both;
}

class Flipping {
public:
    explicit Flipping(const Mesh& mesh)
        : mesh_(mesh), faces_(mesh.faces), face_edges_(mesh.face_edges), plane_(mesh.face_count()),
          is_waiting_(mesh.edge_count(), false) {
        for (uint32_t e = 0; e < mesh.edge_count(); ++e) {
            const auto beside = mesh.edge_faces[e];
            sides_.push_back(beside.size() == 2 ? std::array{beside[0], beside[1]} : std::array{NONE, NONE});
        }
        join_planes();
    }

    // Returns whether any edge was flipped.
    bool run() {
        for (uint32_t e = mesh_.edge_count(); e-- > 0;) put(e);
        uint64_t left = MOST_FLIPS * mesh_.edge_count();
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

    // Puts planes back in which edges have not become much shorter, and those that cover themselves. Returns
    // whether any plane is left.
    bool keep_what_is_worth_it() {
        std::vector<double> before(faces_.size(), 0), after(faces_.size(), 0); // by plane
        for (uint32_t f = 0; f < faces_.size(); ++f) {
            before[plane_[f]] += squares_of_edges(mesh_.faces[f]);
            after[plane_[f]] += squares_of_edges(faces_[f]);
        }
        std::vector<uint8_t> is_kept(faces_.size());
        for (uint32_t f = 0; f < faces_.size(); ++f) is_kept[f] = after[f] < WORTH_IT * before[f];
        leave_out_covered(is_kept);
        bool any = false;
        for (uint32_t f = 0; f < faces_.size(); ++f) {
            if (is_kept[plane_[f]]) {
                any = true;
            } else {
                faces_[f] = mesh_.faces[f];
                plane_[f] = NONE;
            }
        }
        return any;
    }

    FlippedEdges take() {
        FlippedEdges flipped;
        flipped.mesh.positions = mesh_.positions;
        flipped.mesh.faces = std::move(faces_);
        flipped.plane_of_face = std::move(plane_);
        connect(flipped.mesh);
        return flipped;
    }

private:
    static constexpr uint64_t MOST_FLIPS = 50; // for each edge of the mesh

    void put(uint32_t edge) {
        if (sides_[edge][0] == NONE || is_waiting_[edge]) return;
        is_waiting_[edge] = true;
        waiting_.push_back(edge);
    }

    uint32_t corner_index_opposite(uint32_t face, uint32_t edge) const {
        return static_cast<uint32_t>(std::ranges::find(face_edges_[face], edge) - face_edges_[face].begin());
    }

    Quadrangle quadrangle(uint32_t edge) const {
        const auto [first, second] = sides_[edge];
        const auto& corners = faces_[first];
        const uint32_t i = corner_index_opposite(first, edge);
        return {first,
                second,
                corners[(i + 1) % 3],
                corners[(i + 2) % 3],
                corners[i],
                faces_[second][corner_index_opposite(second, edge)]};
    }

    bool may_flip(uint32_t edge) const {
        const Quadrangle q = quadrangle(edge);
        if (plane_[q.first] != plane_[q.second]) return false;
        const auto& at = mesh_.positions;
        const Angle at_c = angle_at(at[q.c], at[q.a], at[q.b]), at_d = angle_at(at[q.d], at[q.a], at[q.b]);
        const bool is_better = !is_delaunay(at_c, at_d) || (are_on_circle(at_c, at_d) && is_shorter(q));
        return is_better && is_flat(q) && find_edge(mesh_, q.c, q.d) == NONE &&
               !new_edges_.contains(edge_key(q.c, q.d));
    }

    // Whether the other diagonal is.
    bool is_shorter(const Quadrangle& q) const {
        const auto& at = mesh_.positions;
        return (at[q.c] - at[q.d]).norm() < SHORTER * (at[q.a] - at[q.b]).norm();
    }

    bool is_flat(const Quadrangle& q) const {
        const auto& at = mesh_.positions;
        return are_in_one_plane(at[q.a], at[q.b], at[q.c], at[q.d]);
    }

    // The faces c, a, b and d, b, a become c, a, d and c, d, b.
    void flip(uint32_t edge) {
        const Quadrangle q = quadrangle(edge);
        const auto edge_opposite = [&](uint32_t face, uint32_t corner) {
            return face_edges_[face][static_cast<size_t>(std::ranges::find(faces_[face], corner) -
                                                         faces_[face].begin())];
        };
        const uint32_t bc = edge_opposite(q.first, q.a), ca = edge_opposite(q.first, q.b);
        const uint32_t ad = edge_opposite(q.second, q.b), bd = edge_opposite(q.second, q.a);
        faces_[q.first] = {q.c, q.a, q.d};
        face_edges_[q.first] = {ad, edge, ca};
        faces_[q.second] = {q.c, q.d, q.b};
        face_edges_[q.second] = {bd, bc, edge};
        replace_side(ad, q.second, q.first);
        replace_side(bc, q.first, q.second);
        new_edges_.erase(edge_key(q.a, q.b));
        new_edges_.insert(edge_key(q.c, q.d));
        for (const uint32_t beside : {bc, ca, ad, bd}) put(beside);
    }

    // A plane is what is connected over edges of the mesh that are flat one by one; as a whole it may bend.
    // Faces without area are flat with any.
    void join_planes() {
        std::iota(plane_.begin(), plane_.end(), 0u);
        for (uint32_t e = 0; e < mesh_.edge_count(); ++e) {
            if (sides_[e][0] == NONE) continue;
            const Quadrangle q = quadrangle(e);
            if (is_flat(q)) plane_[plane_of(q.first)] = plane_of(q.second);
        }
        for (uint32_t f = 0; f < mesh_.face_count(); ++f) plane_[f] = plane_of(f);
    }

    // Around a vertex with angles of more than a turn together, a plane lies over itself. A position does not
    // tell there which of its faces a point lies in. Faces without area have angles that say nothing.
    void leave_out_covered(std::vector<uint8_t>& is_kept) const {
        constexpr double MOST = 2 * std::numbers::pi + 0.01;
        std::vector<std::pair<uint64_t, double>> angles; // by plane and vertex
        for (uint32_t f = 0; f < mesh_.face_count(); ++f) {
            if (!is_kept[plane_[f]]) continue;
            const auto& corners = mesh_.faces[f];
            for (size_t k = 0; k < 3; ++k) {
                const auto [sine, cosine] =
                    angle_at(mesh_.positions[corners[k]], mesh_.positions[corners[(k + 1) % 3]],
                             mesh_.positions[corners[(k + 2) % 3]]);
                if (sine > FLATNESS)
                    angles.emplace_back(uint64_t{plane_[f]} << 32 | corners[k], std::atan2(sine, cosine));
            }
        }
        std::ranges::sort(angles);
        double sum = 0;
        for (size_t i = 0; i < angles.size(); ++i) {
            sum = i > 0 && angles[i - 1].first == angles[i].first ? sum + angles[i].second : angles[i].second;
            if (sum > MOST) is_kept[angles[i].first >> 32] = 0;
        }
    }

    // One of its faces stands for a plane. The others lead to it.
    uint32_t plane_of(uint32_t face) {
        while (plane_[face] != face) face = plane_[face] = plane_[plane_[face]];
        return face;
    }

    double squares_of_edges(const std::array<uint32_t, 3>& corners) const {
        double sum = 0;
        for (size_t k = 0; k < 3; ++k)
            sum += (mesh_.positions[corners[k]] - mesh_.positions[corners[(k + 1) % 3]]).squaredNorm();
        return sum;
    }

    void replace_side(uint32_t edge, uint32_t before, uint32_t after) {
        for (uint32_t& face : sides_[edge])
            if (face == before) face = after;
    }

    const Mesh& mesh_;
    std::vector<std::array<uint32_t, 3>> faces_, face_edges_;
    std::vector<std::array<uint32_t, 2>> sides_; // per edge: its faces, or NONE if it does not have two
    std::vector<uint32_t> plane_;                // per face: the one that stands for its plane
    std::unordered_set<uint64_t> new_edges_;     // by edge_key(); that the mesh did not have
    std::vector<uint32_t> waiting_;
    std::vector<bool> is_waiting_;
};

}

std::optional<FlippedEdges> flip_flat_edges(const Mesh& mesh) {
    Flipping flipping(mesh);
    if (!flipping.run() || !flipping.keep_what_is_worth_it()) return std::nullopt;
    return flipping.take();
}

}
