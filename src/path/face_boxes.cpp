#include "src/path/face_boxes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "src/mesh/spatial_order.h"

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

std::vector<uint32_t> faces_in_order(const Surface& surface) {
    std::vector<Vector3d> middles;
    std::vector<uint32_t> faces(surface.face_count());
    for (uint32_t f = 0; f < surface.face_count(); ++f) {
        const auto [a, b, c] = corners_of(surface, f);
        middles.emplace_back((a + b + c) / 3);
        faces[f] = f;
    }
    return spatial_order(middles, std::move(faces));
}

float rounded_down(double value) {
    return std::nextafter(static_cast<float>(value), -std::numeric_limits<float>::infinity());
}
float rounded_up(double value) {
    return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity());
}

}

// Over the plane of the face if the foot lies inside of it, and else on the nearest of the three edges. A
// face without an area has edges only.
SurfacePoint closest_on_face(const Surface& surface, uint32_t face, const Vector3d& position) {
    const auto corners = corners_of(surface, face);
    const Vector3d u = corners[1] - corners[0], v = corners[2] - corners[0], normal = u.cross(v);
    if (const double area = normal.squaredNorm(); area > 0) {
        const Vector3d w = position - corners[0];
        const double second = w.cross(v).dot(normal) / area, third = u.cross(w).dot(normal) / area;
        if (second >= 0 && third >= 0 && second + third <= 1)
            return {face, {1 - second - third, second, third}};
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
    return best;
}

FaceBoxes::FaceBoxes(const Surface& surface) : order_(faces_in_order(surface)) {
    const uint32_t leaves = std::bit_ceil((surface.face_count() + FACES_PER_LEAF - 1) / FACES_PER_LEAF);
    constexpr float FAR = std::numeric_limits<float>::infinity();
    first_leaf_ = leaves - 1;
    boxes_.assign(size_t{2} * leaves - 1, {{FAR, FAR, FAR}, {-FAR, -FAR, -FAR}});
    for (uint32_t leaf = 0; leaf < leaves; ++leaf) boxes_[first_leaf_ + leaf] = box_of_leaf(surface, leaf);
    for (uint32_t i = first_leaf_; i-- > 0;)
        for (const Box& child : {boxes_[2 * i + 1], boxes_[2 * i + 2]})
            for (size_t k = 0; k < 3; ++k) {
                boxes_[i].low[k] = std::min(boxes_[i].low[k], child.low[k]);
                boxes_[i].high[k] = std::max(boxes_[i].high[k], child.high[k]);
            }
}

// A leaf without faces has a box that nothing is near to.
FaceBoxes::Box FaceBoxes::box_of_leaf(const Surface& surface, uint32_t leaf) const {
    Box box = boxes_[first_leaf_ + leaf];
    const size_t end = std::min(order_.size(), size_t{FACES_PER_LEAF} * (leaf + 1));
    for (size_t i = size_t{FACES_PER_LEAF} * leaf; i < end; ++i)
        for (const Vector3d& corner : corners_of(surface, order_[i]))
            for (size_t k = 0; k < 3; ++k) {
                const double coordinate = corner[static_cast<Eigen::Index>(k)];
                box.low[k] = std::min(box.low[k], rounded_down(coordinate));
                box.high[k] = std::max(box.high[k], rounded_up(coordinate));
            }
    return box;
}

double FaceBoxes::square_to(uint32_t box, const Vector3d& position) const {
    double square = 0;
    for (size_t k = 0; k < 3; ++k) {
        const double x = position[static_cast<Eigen::Index>(k)];
        const double off = std::max({boxes_[box].low[k] - x, x - boxes_[box].high[k], 0.0});
        square += off * off;
    }
    return square;
}

void FaceBoxes::search_leaf(const Surface& surface, uint32_t leaf, const Vector3d& position,
                            ClosestPoint& best) const {
    const size_t end = std::min(order_.size(), size_t{FACES_PER_LEAF} * (leaf + 1));
    for (size_t i = size_t{FACES_PER_LEAF} * leaf; i < end; ++i) {
        const SurfacePoint point = closest_on_face(surface, order_[i], position);
        const double distance = (position_of(surface, point) - position).stableNorm();
        if (best.point.face == NONE || distance < best.distance) best = {point, distance};
    }
}

// The nearer of two boxes first; a box farther than what has been found is passed over.
ClosestPoint FaceBoxes::closest(const Surface& surface, const Vector3d& position) const {
    ClosestPoint best{{NONE, {}}, std::numeric_limits<double>::infinity()};
    std::array<std::pair<double, uint32_t>, 64> waiting;
    size_t count = 0;
    waiting[count++] = {square_to(0, position), 0};
    while (count > 0) {
        const auto [square, box] = waiting[--count];
        if (best.point.face != NONE && square > best.distance * best.distance) continue;
        if (box >= first_leaf_) {
            search_leaf(surface, box - first_leaf_, position, best);
            continue;
        }
        const std::pair<double, uint32_t> first{square_to(2 * box + 1, position), 2 * box + 1},
            second{square_to(2 * box + 2, position), 2 * box + 2};
        waiting[count++] = std::max(first, second);
        waiting[count++] = std::min(first, second);
    }
    return best;
}

}
