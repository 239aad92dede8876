#include "src/surface/face_boxes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace geodesic {

namespace {

using Eigen::AlignedBox3d;
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

// Whether a is nearer to a position than b. From far away both lengths may be the same but for rounding.
bool is_nearer(const Vector3d& a, const Vector3d& b, const Vector3d& position) {
    return (a - b).dot((a - position) + (b - position)) < 0;
}

// Where the foot of a position on the plane of a face is, if it lies inside of the face.
struct Foot {
    bool is_inside = false;
    bool is_sure = false; // the plane of a needle is mostly rounding
    SurfacePoint point{};
};

Foot foot_on_face(uint32_t face, const std::array<Vector3d, 3>& corners, const Vector3d& position) {
    constexpr double NEEDLE = 1e-6; // its height, as a share of its longest edge
    const Vector3d u = corners[1] - corners[0], v = corners[2] - corners[0], normal = u.cross(v);
    const double area = normal.squaredNorm();
    if (!(area > 0)) return {};
    const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (v - u).squaredNorm()});
    const Vector3d w = position - corners[0];
    const double second = w.cross(v).dot(normal) / area, third = u.cross(w).dot(normal) / area;
    const double first = 1 - second - third; // may be negative where the sum of both is rounded to 1
    if (!(first >= 0 && second >= 0 && third >= 0)) return {};
    return {
        true, area > NEEDLE * NEEDLE * longest * longest, {face, without_negligible({first, second, third})}};
}

SurfacePoint closest_on_edges(uint32_t face, const std::array<Vector3d, 3>& corners,
                              const Vector3d& position) {
    SurfacePoint best{face, {1, 0, 0}};
    Vector3d best_at = corners[0];
    for (size_t k = 0; k < 3; ++k) {
        const size_t next = (k + 1) % 3;
        const double share = share_along(corners[k], corners[next], position);
        const Vector3d at = (1 - share) * corners[k] + share * corners[next];
        if (!is_nearer(at, best_at, position)) continue;
        best_at = at;
        best.weights = {};
        best.weights[k] = 1 - share;
        best.weights[next] = share;
    }
    best.weights = without_negligible(best.weights);
    return best;
}

constexpr uint32_t FACES_PER_LEAF = 8; // at least, unless the surface has fewer
constexpr double STEPS = std::numeric_limits<uint16_t>::max();

// About as many whole steps, which may be negative ones, as lead from one end to a place, and no more: what
// place() makes of them is not beyond it.
uint16_t steps_to(double from, double step, double place) {
    const double share = step != 0 ? std::clamp((place - from) / step, 0.0, STEPS) : 0;
    auto steps = static_cast<uint16_t>(share);
    const auto is_beyond = [&](double at) { return step > 0 ? at > place : at < place; };
    while (steps > 0 && is_beyond(from + steps * step)) --steps;
    return steps;
}

}

// Over the plane of the face if the foot lies inside of it, and else on the nearest of the three edges. A
// face without an area has edges only.
SurfacePoint closest_on_face(const Surface& surface, uint32_t face, const Vector3d& position) {
    const auto corners = corners_of(surface, face);
    const Foot foot = foot_on_face(face, corners, position);
    if (foot.is_inside && foot.is_sure) return foot.point;
    const SurfacePoint on_edge = closest_on_edges(face, corners, position);
    const bool is_foot_nearer = foot.is_inside && is_nearer(position_of(surface, foot.point),
                                                            position_of(surface, on_edge), position);
    return is_foot_nearer ? foot.point : on_edge;
}

FaceBoxes::FaceBoxes(const Surface& surface) {
    const uint32_t leaves = std::bit_floor(std::max(1u, surface.face_count() / FACES_PER_LEAF));
    first_leaf_ = leaves - 1;
    std::vector<AlignedBox3d> exact(size_t{2} * leaves - 1);
    for (uint32_t leaf = 0; leaf < leaves; ++leaf) exact[first_leaf_ + leaf] = around_leaf(surface, leaf);
    for (uint32_t i = first_leaf_; i-- > 0;) exact[i] = exact[2 * i + 1].merged(exact[2 * i + 2]);
    whole_ = exact[0];
    boxes_.resize(exact.size());
    for (uint32_t i = 1; i < boxes_.size(); ++i) {
        const AlignedBox3d& around = exact[(i - 1) / 2]; // as it is placed already
        boxes_[i] = inside_of(around, exact[i]);
        exact[i] = place(around, boxes_[i]);
    }
}

FaceBoxes::Box FaceBoxes::inside_of(const AlignedBox3d& around, const AlignedBox3d& exact) {
    Box box{};
    const Vector3d step = around.sizes() / STEPS;
    for (size_t k = 0; k < 3; ++k) {
        const auto axis = static_cast<Eigen::Index>(k);
        box.low[k] = steps_to(around.min()[axis], step[axis], exact.min()[axis]);
        box.high[k] = steps_to(around.max()[axis], -step[axis], exact.max()[axis]);
    }
    return box;
}

AlignedBox3d FaceBoxes::place(const AlignedBox3d& around, const Box& box) {
    const Vector3d step = around.sizes() / STEPS;
    return {around.min() + Vector3d(box.low[0], box.low[1], box.low[2]).cwiseProduct(step),
            around.max() - Vector3d(box.high[0], box.high[1], box.high[2]).cwiseProduct(step)};
}

// Every leaf has as many faces as any other, or one more or less.
uint32_t FaceBoxes::first_face_of(const Surface& surface, uint32_t leaf) const {
    return static_cast<uint32_t>(uint64_t{leaf} * surface.face_count() / (first_leaf_ + 1));
}

AlignedBox3d FaceBoxes::around_leaf(const Surface& surface, uint32_t leaf) const {
    AlignedBox3d box;
    for (uint32_t f = first_face_of(surface, leaf); f < first_face_of(surface, leaf + 1); ++f)
        for (const uint32_t corner : surface.faces[f]) box.extend(surface.positions[corner]);
    return box;
}

// What has been found. Whatever may be no farther, but for the rounding of squares, is looked at.
struct FaceBoxes::Nearest {
    bool may_be_beaten_at(double square) const {
        constexpr double ROUNDING = 1e-14;
        return point.face == NONE || square * (1 - ROUNDING) <= distance * distance;
    }

    SurfacePoint point{NONE, {}};
    Vector3d at = Vector3d::Zero();
    double distance = std::numeric_limits<double>::infinity();
};

void FaceBoxes::search_leaf(const Surface& surface, uint32_t leaf, const Vector3d& position,
                            Nearest& best) const {
    for (uint32_t f = first_face_of(surface, leaf); f < first_face_of(surface, leaf + 1); ++f) {
        if (!best.may_be_beaten_at(square_to_box_of(surface, f, position))) continue;
        const SurfacePoint point = closest_on_face(surface, f, position);
        const Vector3d at = position_of(surface, point);
        if (best.point.face == NONE || is_nearer(at, best.at, position))
            best = {point, at, (at - position).stableNorm()};
    }
}

// The nearer of two boxes first; a box farther than what has been found is passed over.
ClosestPoint FaceBoxes::closest(const Surface& surface, const Vector3d& position) const {
    struct Waiting {
        double square;
        uint32_t number;
        AlignedBox3d box;
    };
    const auto waiting_at = [&](uint32_t number, const AlignedBox3d& box) {
        return Waiting{box.squaredExteriorDistance(position), number, box};
    };
    Nearest best;
    std::array<Waiting, 32> waiting; // one for each level of boxes, of which no surface has so many
    size_t count = 0;
    waiting[count++] = waiting_at(0, whole_);
    while (count > 0) {
        const Waiting next = waiting[--count];
        if (!best.may_be_beaten_at(next.square)) continue;
        if (next.number >= first_leaf_) {
            search_leaf(surface, next.number - first_leaf_, position, best);
            continue;
        }
        const uint32_t first = 2 * next.number + 1, second = first + 1;
        Waiting nearer = waiting_at(first, place(next.box, boxes_[first])),
                farther = waiting_at(second, place(next.box, boxes_[second]));
        if (farther.square < nearer.square) std::swap(nearer, farther);
        waiting[count++] = farther;
        waiting[count++] = nearer;
    }
    return {best.point, best.distance};
}

}
