#include "src/surface/flat_faces.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

namespace geodesic {

namespace {

using Eigen::Vector3d;

constexpr double LEAST_WEIGHT = -1e-9; // of a point inside: rounding may leave so much less than 0
// How far a point may be off the plane of a face, as a share of how far its corners are, and a way off the
// surface, as a share of its length. Planes may be bent a little, see flip_flat_edges().
constexpr double OFF_SURFACE = 1e-3;

// Weights of the foot of a point in the plane of a face, by the corners `first` and two others.
std::array<double, 3> weights_of(const Vector3d& first, const Vector3d& second, const Vector3d& third,
                                 const Vector3d& point) {
    const Vector3d to_second = second - first, to_third = third - first, to_point = point - first;
    const Vector3d normal = to_second.cross(to_third);
    const double square = normal.squaredNorm();
    const double of_second = to_point.cross(to_third).dot(normal) / square;
    const double of_third = to_second.cross(to_point).dot(normal) / square;
    return {1 - of_second - of_third, of_second, of_third};
}

bool is_inside(const std::array<double, 3>& weights) { return std::ranges::min(weights) >= LEAST_WEIGHT; }

std::array<double, 3> without_rounding(std::array<double, 3> weights) {
    for (double& weight : weights) weight = std::max(weight, 0.0);
    const double sum = weights[0] + weights[1] + weights[2];
    for (double& weight : weights) weight /= sum;
    return weights;
}

}

FlatFaces::FlatFaces(const std::optional<FlippedEdges>& flipped) {
    if (!flipped) return;
    const Mesh& mesh = flipped->mesh;
    const auto& planes = flipped->plane_of_face;
    for (uint32_t f = 0; f < mesh.face_count(); ++f)
        if (planes[f] != NONE) number_.push_back(f);
    replaced_ = RankedSet(number_, mesh.face_count());
    plane_.reserve(number_.size());
    for (auto* list : {&faces_, &across_}) list->reserve(number_.size());
    std::vector<std::pair<uint32_t, uint32_t>> at_vertices; // vertex and row of a face there
    for (const uint32_t f : number_) {
        for (const uint32_t corner : mesh.faces[f])
            at_vertices.emplace_back(corner, static_cast<uint32_t>(faces_.size()));
        plane_.push_back(planes[f]);
        faces_.push_back(mesh.faces[f]);
    }
    list_around_vertices(std::move(at_vertices), mesh.vertex_count());
    for (const uint32_t f : number_) {
        auto& across = across_.emplace_back();
        for (size_t k = 0; k < 3; ++k) {
            const auto beside = mesh.edge_faces[mesh.face_edges[f][k]];
            across[k] = NONE;
            if (beside.size() != 2) continue;
            const uint32_t other = beside[beside[0] == f];
            if (planes[other] == planes[f]) across[k] = replaced_.rank(other);
        }
    }
}

void FlatFaces::list_around_vertices(std::vector<std::pair<uint32_t, uint32_t>> at_vertices,
                                     uint32_t vertex_count) {
    std::ranges::sort(at_vertices);
    std::vector<uint32_t> vertices;
    around_.reserve(at_vertices.size());
    for (const auto& [vertex, row] : at_vertices) {
        if (vertices.empty() || vertices.back() != vertex) {
            vertices.push_back(vertex);
            around_begin_.push_back(static_cast<uint32_t>(around_.size()));
        }
        around_.push_back(row);
    }
    around_begin_.push_back(static_cast<uint32_t>(around_.size()));
    around_begin_.shrink_to_fit();
    vertices_ = RankedSet(vertices, vertex_count);
}

// Mostly, the corner with the largest weight sees the point past the fewest faces.
FlatFaces::Corners FlatFaces::corners_of(std::span<const Vector3d> positions,
                                         const std::array<uint32_t, 3>& corners,
                                         const std::array<double, 3>& weights) {
    Corners point{corners, Vector3d::Zero(), std::ranges::max(weights) == 1};
    std::array<size_t, 3> order{0, 1, 2};
    std::ranges::sort(order, {}, [&](size_t k) { return std::pair(-weights[k], k); });
    for (size_t k = 0; k < 3; ++k) {
        point.vertices[k] = corners[order[k]];
        point.position += weights[k] * positions[corners[k]];
    }
    return point;
}

std::span<const uint32_t> FlatFaces::around(uint32_t vertex) const {
    if (!vertices_.contains(vertex)) return {};
    const uint32_t* const begin = around_begin_.data() + vertices_.rank(vertex);
    return {around_.data() + begin[0], around_.data() + begin[1]};
}

SurfacePoint FlatFaces::point_at(const Located& located) const {
    return {number_[located.row], without_rounding(located.weights)};
}

// Walks straight from one point of a plane to another one, from face to face.
class FlatFaces::Walk {
public:
    Walk(const FlatFaces& flat, std::span<const Vector3d> positions, const Vector3d& from, const Vector3d& to)
        : flat_(flat), at_(positions), from_(from), way_(to - from), to_(to) {}

    // Begins at a vertex, in the one of the plane's faces around it that the way leads into; in any of them
    // if the way ends there. Returns whether there is one.
    bool begin_at(uint32_t vertex, uint32_t plane) {
        double best = LEAST_WEIGHT;
        row_ = NONE;
        for (const uint32_t row : flat_.around(vertex)) {
            if (flat_.plane_[row] != plane || !lies_in_plane_of(row)) continue;
            const auto& corners = flat_.faces_[row];
            const auto k = static_cast<size_t>(std::ranges::find(corners, vertex) - corners.begin());
            const uint32_t right = corners[(k + 1) % 3], left = corners[(k + 2) % 3];
            const auto weights = weights_of(from_, at_[right], at_[left], to_);
            const double ahead = weights[1] + weights[2], between = std::min(weights[1], weights[2]) / ahead;
            if (!way_.isZero(0) && !(ahead > 0 && between >= best)) continue;
            best = between;
            leave(row, right, left);
        }
        return row_ != NONE;
    }

    // Begins inside of a face. Returns whether the way lies in its plane and leads out of it over an edge.
    bool begin_in(uint32_t row) {
        row_ = NONE;
        if (!lies_in_plane_of(row)) return false;
        const auto& corners = flat_.faces_[row];
        to_left_ = normal_of(row).cross(way_);
        for (size_t k = 0; k < 3; ++k)
            if (!is_left(corners[k]) && is_left(corners[(k + 1) % 3]))
                leave(row, corners[k], corners[(k + 1) % 3]);
        return row_ != NONE;
    }

    // Goes on to the face with the end of the way, if the way leaves the surface nowhere before.
    std::optional<Located> run() {
        for (size_t step = 0; step <= flat_.faces_.size(); ++step) {
            const auto& [a, b, c] = flat_.faces_[row_];
            const auto weights = weights_of(at_[a], at_[b], at_[c], to_);
            if (is_inside(weights)) {
                if (!lies_in_plane_of(row_) || !ends_in_plane()) return std::nullopt;
                return Located{row_, weights};
            }
            if (!cross()) return std::nullopt;
        }
        return std::nullopt;
    }

private:
    Vector3d normal_of(uint32_t row) const {
        const auto& [a, b, c] = flat_.faces_[row];
        return (at_[b] - at_[a]).cross(at_[c] - at_[a]).normalized();
    }
    double off_to_left(uint32_t vertex) const { return to_left_.dot(at_[vertex] - from_); }
    bool is_left(uint32_t vertex) const { return off_to_left(vertex) > 0; }

    bool lies_in_plane_of(uint32_t row) const {
        return std::abs(normal_of(row).dot(way_)) <= OFF_SURFACE * way_.norm();
    }

    bool ends_in_plane() const {
        const Vector3d normal = normal_of(row_);
        double longest = 0;
        for (const uint32_t corner : flat_.faces_[row_])
            longest = std::max(longest, (at_[corner] - to_).norm());
        return std::abs(normal.dot(to_ - at_[flat_.faces_[row_][0]])) <= OFF_SURFACE * longest;
    }

    // The way leaves this face over the edge between two corners, which follow each other around it.
    void leave(uint32_t row, uint32_t right, uint32_t left) {
        row_ = row;
        right_ = right;
        left_ = left;
        to_left_ = normal_of(row).cross(way_);
    }

    // Whether the edge between right_ and left_ meets the way: one plane may have creases.
    bool meets_edge() const {
        const double right = off_to_left(right_), left = off_to_left(left_);
        const Vector3d met = at_[right_] - from_ + right / (right - left) * (at_[left_] - at_[right_]);
        const Vector3d along = way_.normalized();
        return (met - along.dot(met) * along).norm() <= OFF_SURFACE * way_.norm();
    }

    // Goes on over that edge.
    bool cross() {
        const auto& corners = flat_.faces_[row_];
        size_t k = 0;
        while (corners[k] == right_ || corners[k] == left_) ++k;
        const uint32_t next = flat_.across_[row_][k];
        if (next == NONE || !meets_edge()) return false;
        row_ = next;
        for (const uint32_t corner : flat_.faces_[next])
            if (corner != right_ && corner != left_) {
                (is_left(corner) ? left_ : right_) = corner;
                return true;
            }
        return false;
    }

    const FlatFaces& flat_;
    const std::span<const Vector3d> at_;
    const Vector3d from_, way_, to_;
    uint32_t row_ = NONE, right_ = NONE, left_ = NONE;
    Vector3d to_left_{0, 0, 0}; // across the way
};

// Where rounding leads astray from the first corner, the others try.
std::optional<FlatFaces::Located> FlatFaces::locate(std::span<const Vector3d> positions, const Corners& point,
                                                    uint32_t plane) const {
    for (const uint32_t vertex : point.vertices) {
        Walk walk(*this, positions, positions[vertex], point.position);
        if (!walk.begin_at(vertex, plane)) continue;
        if (const auto found = walk.run()) return found;
    }
    return std::nullopt;
}

double FlatFaces::straight_between(std::span<const Vector3d> positions, const Corners& a, const Corners& b,
                                   uint32_t plane) const {
    const auto at_a = locate(positions, a, plane), at_b = locate(positions, b, plane);
    if (!at_a || !at_b) return UNREACHABLE;
    const auto sees = [&](const Corners& from, const Located& at_from, const Corners& to,
                          const Located& at_to) {
        Walk walk(*this, positions, from.position, to.position);
        if (!(from.is_vertex ? walk.begin_at(from.vertices[0], plane) : walk.begin_in(at_from.row)))
            return false;
        const auto end = walk.run();
        if (!end || end->row == at_to.row) return end.has_value();
        const auto& corners = faces_[end->row];
        return to.is_vertex && std::ranges::find(corners, to.vertices[0]) != corners.end();
    };
    if (!sees(a, *at_a, b, *at_b) && !sees(b, *at_b, a, *at_a)) return UNREACHABLE;
    return (a.position - b.position).norm();
}

}
