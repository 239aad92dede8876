#include "src/path/strip_search.h"

#include <algorithm>
#include <array>
#include <utility>

#include "src/base/number_map.h"
#include "src/path/edge_crossing.h"
#include "src/path/nearby.h"
#include "src/path/open_nodes.h"

namespace geodesic {

namespace {

using Eigen::Vector3d;

class FaceSearch {
public:
    FaceSearch(const Surface& surface, const SurfacePoint& source, const SurfacePoint& target,
               const TargetDistances& distances)
        : surface_(surface), distances_(distances), target_position_(position_of(surface, target)) {
        for_each_alias(surface, source, [&](const SurfacePoint& alias) { sources_.push_back(alias); });
        for_each_alias(surface, target, [&](const SurfacePoint& alias) { targets_.push_back(alias); });
    }

    std::optional<Strip> run();

private:
    enum class Kind { FACE, VERTEX, TARGET };
    struct Node {
        Kind kind;
        uint32_t item;
        Portal portal; // that a face was entered by; NONE twice where the way begins
        Vector3d at;
        double length; // up to there
        uint32_t before;
    };

    // What is known of a face, or of a vertex and its distance to the target.
    struct Met {
        double expected = UNREACHABLE; // the least length in all over nodes that are open there
        double rest = UNKNOWN;
    };
    static constexpr double UNKNOWN = -1;
    static constexpr double CLOSED = -UNREACHABLE; // expected where no node is opened any more

    // An edge, and how far its ends are from the target.
    struct Edge {
        Portal ends;
        double from_a, from_b;
    };

    Met& met(Kind kind, uint32_t item) { return kind == Kind::FACE ? faces_[item] : vertices_[item]; }
    double rest_from(uint32_t vertex);
    void open(Met& met, double rest, Node&& node);
    bool close(const Node& node);
    void reach_target(uint32_t index);
    void leave_face(uint32_t index);
    void pass_vertex(uint32_t index, const Node& node, uint32_t vertex);
    void pass_edge(uint32_t index, const Node& node, const Edge& edge);
    EdgeCrossing cross_edge(const Edge& edge, const Vector3d& from);
    void leave_vertex(uint32_t index);
    Strip strip_to(uint32_t index) const;

    const Surface& surface_;
    const TargetDistances& distances_;
    const Vector3d target_position_;
    std::vector<SurfacePoint> sources_, targets_;
    OpenNodes<Node> open_;
    NumberMap<Met> faces_, vertices_;
};

double FaceSearch::rest_from(uint32_t vertex) {
    double& rest = vertices_[vertex].rest;
    if (rest == UNKNOWN) rest = distances_.at_vertex(vertex);
    return rest;
}

// Unless the face or vertex is closed or will be before this node's turn.
void FaceSearch::open(Met& met, double rest, Node&& node) {
    const double expected = node.length + rest * (1 + distances_.error);
    if (!(expected < met.expected)) return;
    met.expected = expected;
    open_.push(expected, std::move(node));
}

bool FaceSearch::close(const Node& node) {
    double& expected = met(node.kind, node.item).expected;
    if (expected == CLOSED) return false;
    expected = CLOSED;
    return true;
}

void FaceSearch::reach_target(uint32_t index) {
    const Node& node = open_[index];
    const double length = node.length + (target_position_ - node.at).norm();
    open_.push(length, {Kind::TARGET, node.item, {}, target_position_, length, index});
}

// What the edge that the way came over leads to was reached from the face before, in a shorter way.
void FaceSearch::leave_face(uint32_t index) {
    const Node node = open_[index];
    if (std::ranges::find(targets_, node.item, &SurfacePoint::face) != targets_.end()) reach_target(index);
    const auto corners = surface_.faces[node.item];
    std::array<double, 3> rests;
    std::ranges::transform(corners, rests.begin(), [&](uint32_t corner) { return rest_from(corner); });
    for (size_t k = 0; k < 3; ++k) {
        size_t i = (k + 1) % 3, j = (k + 2) % 3;
        if (corners[j] < corners[i]) std::swap(i, j);
        const Edge opposite{{corners[i], corners[j]}, rests[i], rests[j]};
        const bool is_entry = opposite.ends == node.portal;
        if (is_entry || node.portal.is_vertex()) pass_vertex(index, node, corners[k]);
        if (!is_entry) pass_edge(index, node, opposite);
    }
}

void FaceSearch::pass_vertex(uint32_t index, const Node& node, uint32_t vertex) {
    Met& met = vertices_[vertex];
    if (met.expected == CLOSED) return;
    const Vector3d at = surface_.positions[vertex];
    const double length = node.length + (at - node.at).norm();
    open(met, met.rest, {Kind::VERTEX, vertex, {}, at, length, index});
}

void FaceSearch::pass_edge(uint32_t index, const Node& node, const Edge& edge) {
    for_each_face_beyond(surface_, node.item, edge.ends.a, edge.ends.b, [&](uint32_t face) {
        Met& met = faces_[face];
        if (met.expected == CLOSED) return;
        const EdgeCrossing crossing = cross_edge(edge, node.at);
        const Vector3d at = position_at(surface_, edge.ends, crossing.share);
        const double length = node.length + (at - node.at).norm();
        open(met, crossing.rest, {Kind::FACE, face, edge.ends, at, length, index});
    });
}

EdgeCrossing FaceSearch::cross_edge(const Edge& edge, const Vector3d& from) {
    const auto [a, b] = edge.ends;
    const auto inside = distances_.inside_edge ? distances_.inside_edge(a, b) : std::span<const double>();
    return geodesic::cross_edge(surface_, a, b, from, edge.from_a, inside, edge.from_b);
}

void FaceSearch::leave_vertex(uint32_t index) {
    const Node node = open_[index];
    const Portal portal{node.item, node.item};
    const double rest = rest_from(node.item);
    for (const uint32_t face : surface_.vertex_faces[node.item])
        open(faces_[face], rest, {Kind::FACE, face, portal, node.at, node.length, index});
}

std::optional<Strip> FaceSearch::run() {
    for (const SurfacePoint& source : sources_)
        open(faces_[source.face], 0,
             {Kind::FACE, source.face, {NONE, NONE}, position_of(surface_, source), 0, NONE});
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
    strip.target = *std::ranges::find(targets_, open_[index].item, &SurfacePoint::face);
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

}
