#include "src/path/flat_faces.h"

#include <algorithm>
#include <numeric>

#include <Eigen/Geometry>

#include "src/mesh/flat_edges.h"

namespace geodesic {

namespace {

using Eigen::Vector3d;

constexpr double ROUNDING = 1e-9; // by how much weights may be below 0

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

bool is_inside(const std::array<double, 3>& weights) { return std::ranges::min(weights) >= -ROUNDING; }

std::array<double, 3> without_rounding(std::array<double, 3> weights) {
    for (double& weight : weights) weight = std::max(weight, 0.0);
    const double sum = weights[0] + weights[1] + weights[2];
    for (double& weight : weights) weight /= sum;
    return weights;
}

}

FlatFaces::FlatFaces(const Mesh& mesh) {
    const std::optional<Mesh> flipped = flip_flat_edges(mesh);
    if (!flipped) return;
    for (uint32_t f = 0; f < mesh.face_count(); ++f)
        if (flipped->faces[f] != mesh.faces[f]) {
            for (const uint32_t corner : flipped->faces[f])
                at_vertices_.emplace_back(corner, static_cast<uint32_t>(faces_.size()));
            replaced_.push_back(f);
            faces_.push_back(flipped->faces[f]);
        }
    std::ranges::sort(at_vertices_);
    for (const uint32_t f : replaced_) {
        auto& across = across_.emplace_back();
        for (size_t k = 0; k < 3; ++k) {
            const auto beside = flipped->edge_faces[flipped->face_edges[f][k]];
            across[k] = NOTHING;
            if (beside.size() > 1) across[k] = OTHER;
            if (beside.size() == 2) across[k] = place_of(beside[beside[0] == f]).value_or(OTHER);
        }
    }
}

std::optional<uint32_t> FlatFaces::place_of(uint32_t face) const {
    const auto found = std::ranges::lower_bound(replaced_, face);
    if (found == replaced_.end() || *found != face) return std::nullopt;
    return static_cast<uint32_t>(found - replaced_.begin());
}

std::span<const std::pair<uint32_t, uint32_t>> FlatFaces::around(uint32_t vertex) const {
    const auto found =
        std::ranges::equal_range(at_vertices_, vertex, {}, &std::pair<uint32_t, uint32_t>::first);
    return {found.begin(), found.end()};
}

// Walks straight from a vertex to a point that it sees, from face to face.
class FlatFaces::Walk {
public:
    Walk(const FlatFaces& flat, std::span<const Vector3d> positions, uint32_t vertex, const Vector3d& point)
        : flat_(flat), at_(positions), vertex_(vertex), point_(point) {}

    std::optional<Point> run() {
        if (!begin()) return std::nullopt;
        for (size_t step = 0; step <= flat_.faces_.size(); ++step) {
            const auto& [a, b, c] = flat_.faces_[place_];
            const auto weights = weights_of(at_[a], at_[b], at_[c], point_);
            if (is_inside(weights)) return point_with(weights);
            if (!cross()) return std::nullopt;
        }
        return std::nullopt;
    }

private:
    // Of the faces around the vertex, the one that the way begins in: the way lies between two of its edges,
    // and in its plane.
    bool begin() {
        constexpr double SLOPE = 1e-3;
        const Vector3d way = point_ - at_[vertex_];
        double best = -ROUNDING;
        bool found = false;
        for (const auto& [vertex, place] : flat_.around(vertex_)) {
            const auto& corners = flat_.faces_[place];
            const size_t k = static_cast<size_t>(std::ranges::find(corners, vertex_) - corners.begin());
            const uint32_t right = corners[(k + 1) % 3], left = corners[(k + 2) % 3];
            const auto weights = weights_of(at_[vertex_], at_[right], at_[left], point_);
            const Vector3d normal = (at_[right] - at_[vertex_]).cross(at_[left] - at_[vertex_]).normalized();
            const double between = std::min(weights[1], weights[2]) / (weights[1] + weights[2]);
            if (!(weights[1] + weights[2] > 0 && between >= best)) continue;
            if (!(std::abs(normal.dot(way)) <= SLOPE * way.norm())) continue;
            best = between;
            found = true;
            place_ = place;
            right_ = right;
            left_ = left;
            to_left_ = normal.cross(way);
        }
        return found;
    }

    // Goes on to the face across the edge between right_ and left_.
    bool cross() {
        const auto& corners = flat_.faces_[place_];
        size_t k = 0;
        while (corners[k] == right_ || corners[k] == left_) ++k;
        const uint32_t next = flat_.across_[place_][k];
        if (next == NOTHING || next == OTHER) return false;
        place_ = next;
        for (const uint32_t corner : flat_.faces_[next])
            if (corner != right_ && corner != left_) {
                (to_left_.dot(at_[corner] - at_[vertex_]) > 0 ? left_ : right_) = corner;
                return true;
            }
        return false;
    }

    Point point_with(const std::array<double, 3>& weights) const {
        Point found{flat_.faces_[place_], without_rounding(weights), {}};
        for (size_t k = 0; k < 3; ++k) found.has_face_beyond[k] = flat_.across_[place_][k] != NOTHING;
        return found;
    }

    const FlatFaces& flat_;
    const std::span<const Vector3d> at_;
    const uint32_t vertex_;
    const Vector3d point_;
    uint32_t place_ = NONE, right_ = NONE,
             left_ = NONE; // the face, and the edge over which the way leaves it
    Vector3d to_left_{0, 0, 0};
};

// The nearest corner sees the point past the fewest faces; if rounding leads astray from there, the others.
std::optional<FlatFaces::Point> FlatFaces::find(std::span<const Vector3d> positions, uint32_t face,
                                                const std::array<uint32_t, 3>& corners,
                                                const std::array<double, 3>& weights) const {
    if (!place_of(face)) return std::nullopt;
    const Vector3d point = weights[0] * positions[corners[0]] + weights[1] * positions[corners[1]] +
                           weights[2] * positions[corners[2]];
    std::array<size_t, 3> order{0, 1, 2};
    std::ranges::sort(order, std::greater(), [&](size_t k) { return weights[k]; });
    for (const size_t k : order)
        if (auto found = Walk(*this, positions, corners[k], point).run()) return found;
    return std::nullopt;
}

}
