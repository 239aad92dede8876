#include "src/surface/face_boxes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

namespace geodesic {

namespace {

using Eigen::Vector3d;

// The share of the edge from a to b at which the point nearest to a position is.
double share_along(const Vector3d& a, const Vector3d& b, const Vector3d& position) {
    const Vector3d along = b - a;
    const double square = along.squaredNorm();
    return square > 0 ? std::clamp((position - a).dot(along) / square, 0.0, 1.0) : 0;
}

std::array<Vector3d, 3> corners_of(const Surface& surface, uint32_t face) {
    const auto& [a, b, c] = surface.faces[face];
    return {surface.positions[a], surface.positions[b], surface.positions[c]};
}

// From a position to the box around a face.
double square_to_box_of(const Surface& surface, uint32_t face, const Vector3d& position) {
    const auto [a, b, c] = corners_of(surface, face);
    const Vector3d low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    return (low - position).cwiseMax(position - high).cwiseMax(0).squaredNorm();
}

constexpr uint32_t FACES_PER_LEAF = 8; // at least, unless the surface has fewer
constexpr double MOST_CELLS = std::numeric_limits<uint16_t>::max();
constexpr double MARGIN = 1; // in cells: far more than the rounding of positions in cells

}

// Over the plane of the face if the foot lies inside of it, and else on the nearest of the three edges. A
// face without an area has edges only.
SurfacePoint closest_on_face(const Surface& surface, uint32_t face, const Vector3d& position) {
    const auto corners = corners_of(surface, face);
    const Vector3d u = corners[1] - corners[0], v = corners[2] - corners[0], normal = u.cross(v);
    if (const double area = normal.squaredNorm(); area > 0) {
        const Vector3d w = position - corners[0];
        const double second = w.cross(v).dot(normal) / area, third = u.cross(w).dot(normal) / area;
        const double first = 1 - second - third; // may be negative where the sum of both is rounded to 1
        if (first >= 0 && second >= 0 && third >= 0)
            return {face, without_negligible({first, second, third})};
    }
    SurfacePoint best{face, {1, 0, 0}};
    double least = std::numeric_limits<double>::infinity();
    for (size_t k = 0; k < 3; ++k) {
        const size_t next = (k + 1) % 3;
        const double share = share_along(corners[k], corners[next], position);
        const double square = ((1 - share) * corners[k] + share * corners[next] - position).squaredNorm();
        if (!(square < least)) continue;
        least = square;
        best.weights = {};
        best.weights[k] = 1 - share;
        best.weights[next] = share;
    }
    best.weights = without_negligible(best.weights);
    return best;
}

FaceBoxes::FaceBoxes(const Surface& surface) {
    Vector3d low = surface.positions[0], high = low;
    for (const Vector3d& position : surface.positions) {
        low = low.cwiseMin(position);
        high = high.cwiseMax(position);
    }
    origin_ = low;
    // A position in the last cell is rounded up, and so takes one more.
    cells_per_length_ = (MOST_CELLS - 2 * MARGIN - 1) / (high - low).maxCoeff();
    const uint32_t leaves = std::bit_floor(std::max(1u, surface.face_count() / FACES_PER_LEAF));
    first_leaf_ = leaves - 1;
    boxes_.resize(size_t{2} * leaves - 1);
    for (uint32_t leaf = 0; leaf < leaves; ++leaf) boxes_[first_leaf_ + leaf] = box_of_leaf(surface, leaf);
    for (uint32_t i = first_leaf_; i-- > 0;) {
        const Box &first = boxes_[2 * i + 1], &second = boxes_[2 * i + 2];
        for (size_t k = 0; k < 3; ++k) {
            boxes_[i].low[k] = std::min(first.low[k], second.low[k]);
            boxes_[i].high[k] = std::max(first.high[k], second.high[k]);
        }
    }
}

Vector3d FaceBoxes::in_cells(const Vector3d& position) const {
    return (position - origin_) * cells_per_length_ + Vector3d::Constant(MARGIN);
}

void FaceBoxes::add_to(Box& box, const Vector3d& position) const {
    const Vector3d cells = in_cells(position);
    for (size_t k = 0; k < 3; ++k) {
        const double at = cells[static_cast<Eigen::Index>(k)];
        box.low[k] = std::min(box.low[k], static_cast<uint16_t>(std::floor(at - MARGIN)));
        box.high[k] = std::max(box.high[k], static_cast<uint16_t>(std::ceil(at + MARGIN)));
    }
}

// Every leaf has as many faces as any other, or one more or less.
uint32_t FaceBoxes::first_face_of(const Surface& surface, uint32_t leaf) const {
    return static_cast<uint32_t>(uint64_t{leaf} * surface.face_count() / (first_leaf_ + 1));
}

FaceBoxes::Box FaceBoxes::box_of_leaf(const Surface& surface, uint32_t leaf) const {
    constexpr auto FAR = static_cast<uint16_t>(MOST_CELLS);
    Box box{{FAR, FAR, FAR}, {0, 0, 0}};
    for (uint32_t f = first_face_of(surface, leaf); f < first_face_of(surface, leaf + 1); ++f)
        for (const uint32_t corner : surface.faces[f]) add_to(box, surface.positions[corner]);
    return box;
}

double FaceBoxes::square_to(uint32_t box, const Vector3d& cells) const {
    double square = 0;
    for (size_t k = 0; k < 3; ++k) {
        const double x = cells[static_cast<Eigen::Index>(k)];
        const double off = std::max({boxes_[box].low[k] - x, x - boxes_[box].high[k], 0.0});
        square += off * off;
    }
    return square;
}

void FaceBoxes::search_leaf(const Surface& surface, uint32_t leaf, const Vector3d& position,
                            ClosestPoint& best) const {
    for (uint32_t f = first_face_of(surface, leaf); f < first_face_of(surface, leaf + 1); ++f) {
        const bool is_first = best.point.face == NONE;
        if (!is_first && square_to_box_of(surface, f, position) > best.distance * best.distance) continue;
        const SurfacePoint point = closest_on_face(surface, f, position);
        const double distance = (position_of(surface, point) - position).stableNorm();
        if (is_first || distance < best.distance) best = {point, distance};
    }
}

// The nearer of two boxes first; a box farther than what has been found is passed over.
ClosestPoint FaceBoxes::closest(const Surface& surface, const Vector3d& position) const {
    const Vector3d cells = in_cells(position);
    ClosestPoint best{{NONE, {}}, std::numeric_limits<double>::infinity()};
    std::array<std::pair<double, uint32_t>, 64> waiting;
    size_t count = 0;
    waiting[count++] = {square_to(0, cells), 0};
    while (count > 0) {
        const auto [square, box] = waiting[--count];
        const double farthest = best.distance * cells_per_length_;
        if (best.point.face != NONE && square > farthest * farthest) continue;
        if (box >= first_leaf_) {
            search_leaf(surface, box - first_leaf_, position, best);
            continue;
        }
        const std::pair<double, uint32_t> first{square_to(2 * box + 1, cells), 2 * box + 1},
            second{square_to(2 * box + 2, cells), 2 * box + 2};
        waiting[count++] = std::max(first, second);
        waiting[count++] = std::min(first, second);
    }
    return best;
}

}
