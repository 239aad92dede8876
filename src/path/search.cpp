#include "src/path/search.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <unordered_map>

#include "src/base/plane.h"
#include "src/path/nearby.h"

namespace geodesic {

namespace {

using Eigen::Vector3d;

// Where a way crosses an edge, and how long it is from there to the target.
struct Crossing {
    double share = 0;
    double rest = UNREACHABLE;
};

// Over a piece of a line, from `begin` to `end`, whose ends have these distances from the target. The way
// comes from a point at `foot` along the line and `height` off it.
void cross_piece(double begin, double end, double from_begin, double from_end, double foot, double height,
                 double& least, double& at, double& rest) {
    const auto offer = [&](double x, double way_on) {
        const double length = hypotenuse(x - foot, height) + way_on;
        if (!(length < least)) return;
        least = length;
        at = x;
        rest = way_on;
    };
    offer(begin, from_begin);
    offer(end, from_end);
    const double length = end - begin;
    const double target = foot_of(length, from_begin, from_end);
    const double square = (from_begin - target) * (from_begin + target);
    if (!(length > 0) || !(square >= 0) || !(square < UNREACHABLE)) return;
    const double off = std::sqrt(square), both = off + height;
    if (!(both > 0)) return;
    const double x = foot - begin + (target - foot + begin) * (height / both);
    if (x > 0 && x < length) offer(begin + x, hypotenuse(x - target, off));
}

// What a search has open, by what is expected in all.
template <class Node>
class Open {
public:
    void push(double expected, Node&& node) {
        queue_.push({expected, static_cast<uint32_t>(nodes_.size())});
        nodes_.push_back(std::move(node));
    }
    bool empty() const { return queue_.empty(); }
    uint32_t pop() {
        const uint32_t node = queue_.top().second;
        queue_.pop();
        return node;
    }
    const Node& operator[](uint32_t i) const { return nodes_[i]; }

private:
    using Entry = std::pair<double, uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
    std::vector<Node> nodes_;
};

class FaceSearch {
public:
    FaceSearch(const Surface& surface, const SurfacePoint& source, const SurfacePoint& target,
               const TargetDistances& distances)
        : surface_(surface), distances_(distances), target_position_(position_of(surface, target)) {
        for_each_alias(surface, source, [&](const SurfacePoint& alias) { sources_.push_back(alias); });
        for_each_alias(surface, target, [&](const SurfacePoint& alias) { targets_[alias.face] = alias; });
    }

    std::optional<Strip> run();

private:
    enum class Kind { FACE, VERTEX, TARGET };
    struct Node {
        Kind kind;
        uint32_t item;
        Portal portal; // that a face was entered by
        Vector3d at;
        double length; // up to there
        uint32_t before;
    };

    double rest_from(uint32_t vertex);
    Crossing cross_edge(uint32_t a, uint32_t b, const Vector3d& from);
    bool close(const Node& node);
    void leave_face(uint32_t index);
    void leave_vertex(uint32_t index);
    Strip strip_to(uint32_t index) const;

    const Surface& surface_;
    const TargetDistances& distances_;
    const Vector3d target_position_;
    std::vector<SurfacePoint> sources_;
    std::unordered_map<uint32_t, SurfacePoint> targets_; // by face
    Open<Node> open_;
    std::unordered_map<uint32_t, double> rest_; // distances that have been asked for
    std::unordered_map<uint32_t, bool> closed_faces_, closed_vertices_;
};

double FaceSearch::rest_from(uint32_t vertex) {
    const auto [found, is_new] = rest_.try_emplace(vertex, 0);
    if (is_new) found->second = distances_.at_vertex(vertex);
    return found->second;
}

Crossing FaceSearch::cross_edge(uint32_t a, uint32_t b, const Vector3d& from) {
    const Vector3d along = surface_.positions[b] - surface_.positions[a];
    const double length = along.norm();
    const auto [foot, height] = place_beside(surface_.positions[a], along / length, from);
    const auto inside = distances_.inside_edge ? distances_.inside_edge(a, b) : std::span<const double>();
    double least = UNREACHABLE, at = 0, last = rest_from(a), rest = UNREACHABLE;
    const double piece = length / static_cast<double>(inside.size() + 1);
    for (size_t i = 0; i <= inside.size(); ++i) {
        const double next = i < inside.size() ? inside[i] : rest_from(b);
        const double begin = static_cast<double>(i) * piece;
        cross_piece(begin, begin + piece, last, next, foot, height, least, at, rest);
        last = next;
    }
    return {std::clamp(at / length, 0.0, 1.0), rest};
}

bool FaceSearch::close(const Node& node) {
    auto& closed = node.kind == Kind::FACE ? closed_faces_ : closed_vertices_;
    return closed.try_emplace(node.item, true).second;
}

void FaceSearch::leave_face(uint32_t index) {
    const Node node = open_[index];
    if (targets_.contains(node.item)) {
        const double length = node.length + (target_position_ - node.at).norm();
        open_.push(length, {Kind::TARGET, node.item, {}, target_position_, length, index});
    }
    for (uint32_t k = 0; k < 3; ++k) {
        const auto& corners = surface_.faces[node.item];
        if (const double rest = rest_from(corners[k]); rest < UNREACHABLE) {
            const Vector3d at = surface_.positions[corners[k]];
            const double length = node.length + (at - node.at).norm();
            open_.push(length + rest, {Kind::VERTEX, corners[k], {}, at, length, index});
        }
        const auto [a, b] = std::minmax(corners[(k + 1) % 3], corners[(k + 2) % 3]);
        const Portal portal{a, b};
        const Crossing crossing = cross_edge(a, b, node.at);
        if (!(crossing.rest < UNREACHABLE)) continue;
        const Vector3d at = position_at(surface_, portal, crossing.share);
        const double length = node.length + (at - node.at).norm();
        for_each_face_beyond(surface_, node.item, a, b, [&](uint32_t face) {
            if (!closed_faces_.contains(face))
                open_.push(length + crossing.rest, {Kind::FACE, face, portal, at, length, index});
        });
    }
}

void FaceSearch::leave_vertex(uint32_t index) {
    const Node node = open_[index];
    for (const uint32_t face : surface_.vertex_faces[node.item])
        if (!closed_faces_.contains(face))
            open_.push(node.length + rest_from(node.item),
                       {Kind::FACE, face, {node.item, node.item}, node.at, node.length, index});
}

std::optional<Strip> FaceSearch::run() {
    for (const SurfacePoint& source : sources_)
        open_.push(0, {Kind::FACE, source.face, {NONE, NONE}, position_of(surface_, source), 0, NONE});
    while (!open_.empty()) {
        const uint32_t index = open_.pop();
        const Node& node = open_[index];
        if (node.kind == Kind::TARGET) return strip_to(index);
        if (!close(node)) continue;
        if (node.kind == Kind::FACE)
            leave_face(index);
        else
            leave_vertex(index);
    }
    return std::nullopt;
}

Strip FaceSearch::strip_to(uint32_t index) const {
    Strip strip;
    strip.target = targets_.at(open_[index].item);
    for (uint32_t i = open_[index].before; i != NONE; i = open_[i].before) {
        if (open_[i].kind == Kind::VERTEX) continue;
        strip.faces.push_back(open_[i].item);
        if (open_[i].portal.a != NONE) strip.portals.push_back(open_[i].portal);
    }
    std::ranges::reverse(strip.faces);
    std::ranges::reverse(strip.portals);
    strip.source = *std::ranges::find(sources_, strip.faces.front(), &SurfacePoint::face);
    return strip;
}

}

std::optional<Strip> search_strip(const Surface& surface, const SurfacePoint& source,
                                  const SurfacePoint& target, const TargetDistances& distances) {
    return FaceSearch(surface, source, target, distances).run();
}

std::optional<std::vector<uint32_t>> search_edges(const Surface& surface, const SurfacePoint& source,
                                                  const SurfacePoint& target,
                                                  const TargetDistances& distances) {
    struct Node {
        uint32_t vertex; // NONE: the target
        double length;
        uint32_t before;
    };
    Open<Node> open;
    const Vector3d from = position_of(surface, source), to = position_of(surface, target);
    const auto reach = [&](uint32_t vertex, double length, uint32_t before) {
        const double rest = distances.at_vertex(vertex);
        if (rest < UNREACHABLE) open.push(length + rest, {vertex, length, before});
    };
    for (const uint32_t corner : surface.faces[source.face])
        reach(corner, (surface.positions[corner] - from).norm(), NONE);
    std::unordered_map<uint32_t, bool> closed;
    while (!open.empty()) {
        const uint32_t index = open.pop();
        const Node node = open[index];
        if (node.vertex == NONE) {
            std::vector<uint32_t> vertices;
            for (uint32_t i = node.before; i != NONE; i = open[i].before) vertices.push_back(open[i].vertex);
            std::ranges::reverse(vertices);
            return vertices;
        }
        if (!closed.try_emplace(node.vertex, true).second) continue;
        const Vector3d at = surface.positions[node.vertex];
        if (corner_of(surface, target.face, node.vertex) != NONE)
            open.push(node.length + (to - at).norm(), {NONE, node.length + (to - at).norm(), index});
        for (const uint32_t face : surface.vertex_faces[node.vertex])
            for (const uint32_t other : surface.faces[face])
                if (other != node.vertex && !closed.contains(other))
                    reach(other, node.length + (surface.positions[other] - at).norm(), index);
    }
    return std::nullopt;
}

}
